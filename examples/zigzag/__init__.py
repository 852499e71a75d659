"""ZigZag: UAVs that relay the data of sensors to a ground station.

Three protocols: `mobile.ZigZagMobile`, `sensor.ZigZagSensor`, `ground_station.ZigZagGroundStation`.
`configs/zigzag.ini` holds the scenarios.

After the GrADyS-SIM NextGen paper, "Developing Algorithms for the Internet of Flying Things Through
Environments With Varying Degrees of Realism". Each lesson that its authors drew is a parameter:
`heartbeat_jitter`, `interaction_timeout`, `launch_interval`.
"""

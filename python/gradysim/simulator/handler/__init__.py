"""The parts of a simulated world: one handler for the network, one for the timers, one for motion."""

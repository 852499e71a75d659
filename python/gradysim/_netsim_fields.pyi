"""The declared fields of the config structs. Written by `make schema`; do not edit."""

from collections.abc import Sequence
from typing import TypeAlias

MessagePart: TypeAlias = str | tuple[float, str] | tuple[str]

class MobilityFields:
    typename: str
    speed_mps: float
    """Speed; with MasslessMobility, QuadcopterMobility and autopilots until the protocol sets another
    one, as every mission of the plugin does."""
    command_delay_s: float
    """Time from a command of the protocol until the vehicle obeys it."""
    telemetry_interval_s: float
    """Time between two calls of handle_telemetry, at least 1us; 0s: no calls. In prototype mode the
    call comes with the first update of all positions at or after its time. Positions are updated every
    10ms, or as often as the shortest interval says; beside quadcopters and autopilots the interval
    cannot be shorter than that."""
    position_error_m: float
    """Standard deviation of the error of the position that telemetry reports, on each horizontal axis.
    QuadcopterMobility flies by this position; radios are where the node is."""
    position_error_time_s: float
    """Time in which the error changes: after it, its correlation is 1/e."""
    position_error_ratio: float
    """Standard deviation of the error of z over that of a horizontal axis."""
    acceleration_mps2: float
    """Largest horizontal and vertical acceleration in m/s²; before a target it brakes with 0.8 times as
    much."""
    drag_kgps: float
    """Force of the air in N per m/s of airspeed, on a vehicle of 2 kg."""
    initial_heading_rad: float
    """How the node is turned at the start: from the x axis to the y axis."""
    initial_elevation_rad: float
    """How far the node is turned upward at the start."""
    initial_bank_rad: float
    """How the node is turned at the start about its own x axis: from the y axis to the z axis."""
    face_forward: bool
    """Whether heading and elevation follow the direction of flight."""
    area_min_x_m: float
    """Smallest x of the area."""
    area_min_y_m: float
    """Smallest y of the area."""
    area_min_z_m: float
    """Smallest z of the area."""
    area_max_x_m: float
    """Largest x of the area."""
    area_max_y_m: float
    """Largest y of the area."""
    area_max_z_m: float
    """Largest z of the area."""
    movement_heading_rad: float
    """Direction of the first leg, from the x axis to the y axis."""
    movement_elevation_rad: float
    """How far the first leg leads upward."""
    center_x_m: float
    """X of the center of the circle."""
    center_y_m: float
    """Y of the center of the circle."""
    center_z_m: float
    """Z of the center of the circle."""
    radius_m: float
    """Radius of the circle, which is flown as a polygon at most 1 cm inside of it."""
    start_angle_rad: float
    """Where on the circle the node starts: from the x axis to the y axis."""
    start_pos: float
    """Where on the border of the area the node starts, in sides: 0 is the corner of the smallest x and
    y, 1 that of the largest x and the smallest y, and so on."""

class ComputerFields:
    processing_time_s: float
    """Median of the time that the computer of a node takes for each event of its protocol, one after
    the other (docs/how-to/model-a-board.md); 0s: none."""
    processing_time_spread: float
    """Standard deviation of the natural logarithm of that time, which has a log-normal distribution; 0:
    always the median."""

class InterfaceFields:
    @property
    def typename(self) -> str: ...
    """Network interface: a station of 802.11, or a device of 802.15.4, whose radio has other
    defaults."""

class MacFields:
    op_mode: str
    """Generation of IEEE 802.11, which sets bit rates and timing."""
    bitrate_bps: float
    """Bit rate of data frames; -1bps: the fastest mandatory one."""
    mtu_bytes: int
    """802.11: largest IP packet, made of 28 B of headers and the message; a longer message is
    refused."""
    multicast_bitrate_bps: float
    """Bit rate of broadcast frames; -1bps: that of data frames."""
    control_bitrate_bps: float
    """Bit rate of RTS frames; -1bps: the fastest mandatory one."""
    basic_bitrates_bps: Sequence[float]
    """Bit rates of ACK and CTS frames: the fastest of them with the modulation of the answered frame
    that is not faster than it; if there is none, and with [], the same among the mandatory bit
    rates."""
    rts_threshold_bytes: int
    """Unicast frames of at least this length begin with RTS and CTS."""
    short_retry_limit: int
    """Number of failures after which an RTS, or a frame below the RTS threshold, is dropped."""
    long_retry_limit: int
    """Number of failures after which a frame at or above the RTS threshold is dropped."""
    inet_station_retry_counters: bool
    """Whether failures are counted across dropped frames, as in INET: from the second in a row on, the
    contention window stays large."""
    ns3_station_window: bool
    """Whether a dropped frame leaves the contention window as it is, as in ns-3 3.44: the failure after
    shortRetryLimit others in a row resets it."""
    cw_min: int
    """Smallest contention window in slots; -1: that of opMode."""
    cw_max: int
    """Largest contention window in slots; -1: that of opMode."""
    queue_capacity: int
    """Number of frames that can wait in the queue, without the one in progress."""
    queue_when_full: str
    """What happens to a message if the queue is full: it is dropped, or it waits in front of the queue,
    and with it the events of its protocol, as with a socket that blocks (docs/how-to/model-a-
    board.md)."""
    backoff_optimization: bool
    """Whether idle time before a frame arrives counts toward its wait."""
    initial_channel_busy: bool
    """For backoffOptimization: whether the channel was busy until the run began; false: it has always
    been idle."""
    skip_backoff_if_idle: bool
    """Whether a frame that finds station and channel idle waits only for DIFS, without a backoff; the
    station is idle after the backoff that follows each frame."""
    inet_eifs: bool
    """Whether EIFS follows INET's rules instead of the standard's."""
    ns3_eifs: bool
    """Whether EIFS begins at the end of the corrupted frame, as in ns-3, instead of when the channel is
    free; a lost PHY header brings none."""
    rate_control: str
    """How the bit rate of unicast frames follows the losses; "": it is constant."""
    initial_rate_bps: float
    """Bit rate of the first frame to a node; -1bps: that of data frames."""
    rate_interval_s: float
    """Time after the last change at which the next faster rate is tried."""
    increase_threshold: int
    """Successes in a row that lead to the next faster rate."""
    decrease_threshold: int
    """Failures in a row that lead to the next slower rate."""
    increase_threshold_factor: float
    """Factor by which increaseThreshold grows when the faster rate fails at once."""
    max_increase_threshold: int
    """Upper bound of that growth."""
    rate_update_interval_s: float
    """Time from one choice of the best rates to the next."""
    look_around_share: float
    """Fraction of the frames that try a random rate."""
    ewma_weight: float
    """Weight of the past in the mean success probability."""
    own_frames_set_nav: bool
    """Whether a node's own frames reserve the channel against itself, as in INET; not in the
    standard."""
    unanswered_rts_resets_nav: bool
    """Whether the channel that an RTS reserved is free again if no frame follows it, as in ns-3."""

class CsmaFields:
    use_acks: bool
    """Whether the interface asks for an ACK of each unicast frame that it sends."""
    max_frame_retries: int
    """Number of retries of a frame without an ACK."""
    ack_wait_s: float
    """How long a sender waits for the end of an ACK."""
    sifs_s: float
    """Time from the end of a frame to its ACK."""
    lifs_s: float
    """Pause after a frame or its ACK, before the next wait; 0s in INET, 640us in the standard."""
    max_backoffs: int
    """Further waits after the first if the channel is busy; then the frame is dropped."""
    backoff_method: str
    """How the longest wait grows when the channel is busy."""
    min_be: int
    """The first wait is 0 to 2^BE - 1 periods."""
    max_be: int
    """BE grows by 1 up to this value."""
    contention_window: int
    """The first wait is 1 to this number of periods."""
    unit_backoff_s: float
    """Period in which waits are counted."""
    cca_s: float
    """How long a device listens before it sends."""
    cca_whole_window: bool
    """Whether the channel must be free during all of that time; in INET, at its end."""
    turnaround_s: float
    """Time from listening to sending, in which the radio is deaf."""
    queue_capacity: int
    """Number of frames that can wait in the queue, without the one in progress."""
    queue_when_full: str
    """What happens to a message if the queue is full: see that of 802.11."""

class RadioFields:
    carrier_hz: float
    """Center of the channel."""
    bandwidth_hz: float
    """Width of the channel; 802.11: 20MHz to 22MHz."""
    tx_power_w: float
    """Transmit power."""
    tx_power_by_bitrate_w: Sequence[tuple[float, float]]
    """Transmit power of frames with these bit rates, such as [[48Mbps, 20dBm], [54Mbps, 19dBm]]; all
    others have transmitter.power."""
    communication_range_m: float
    """UnitDiskRadioMedium: radius of the circle. Other media: sets the lowest power at which at least
    half of the broadcast messages of 50 B arrive at that distance; of it and transmitter.power, the
    first line counts."""
    sensitivity_w: float
    """Weakest frame that the radio can receive."""
    energy_detection_w: float
    """Power (noise and signals together) from which on the channel counts as busy."""
    snir_threshold: float
    """Signal to noise and interference ratio at or below which every frame is lost."""
    error_model: str
    """How noise becomes lost frames; "": only snirThreshold counts."""
    ber_table_file: str
    """CSV file of packet success over SNIR, relative to the .ini file; the format is this project's own
    (docs/how-to/choose-a-receiver.md)."""
    snir_mode: str
    """What decides about a frame: its lowest SNIR, or the SNIR of each stretch of time for its part of
    the frame, without the preamble (docs/how-to/choose-a-receiver.md)."""
    collision_model: str
    """When interference destroys a frame; snir: by its SNIR; overlap: always, if the interference
    reaches the sensitivity."""
    noise_figure: float
    """Noise that the receiver adds."""
    preamble_detection: str
    """When a radio locks on to a frame; "": at once, otherwise when it has detected the preamble."""
    preamble_threshold: float
    """Lowest SNIR."""
    preamble_minimum_power_w: float
    """Lowest power of the frame."""
    preamble_duration_s: float
    """How long a radio listens before it decides."""
    lost_header_frees_channel: bool
    """Whether the channel counts as free after a lost PHY header, despite the energy of frames in the
    air; needs snirMode "chunks"."""
    frame_capture: str
    """Whether a stronger frame can replace one whose reception has begun; "": never."""
    capture_margin: float
    """How much stronger the later frame must be."""
    capture_window_s: float
    """How long after the start of the earlier frame."""

class AntennaFields:
    typename: str
    """In which directions the antenna sends and receives."""
    gain: float
    """Gain in all directions."""
    max_gain: float
    """Gain along the boresight, its x axis."""
    min_gain: float
    """Gain outside of the beam."""
    beam_width_rad: float
    """Angle between the directions of half the power."""
    wire_axis: str
    """Axis along which it lies."""
    length_m: float
    """From end to end, at most one wavelength; 0m: much shorter than the wave."""
    offset_heading_rad: float
    """How the antenna is turned on the node: from the node's x axis to its y axis."""
    offset_elevation_rad: float
    """The same upward: -90deg points down."""
    offset_bank_rad: float
    """The same about the antenna's own x axis."""

class MediumFields:
    @property
    def typename(self) -> str: ...
    """Model of the air: path loss and noise, or a circle."""
    timing: str
    """What takes time; mac: what the MAC of each interface does, not with UnitDiskRadioMedium. The
    others have no MAC, for comparison (docs/explanation/realism-levels.md); instant: nothing; airtime:
    frames and their way at the speed of light; aloha: the same, and frames that overlap are lost;
    channelAccess: waiting until the channel around the sender is free, too, so that frames never
    collide."""
    background_noise: str
    """Noise in a channel: one power for all, or that of the receiver's bandwidth."""
    background_noise_w: float
    """Noise in the channel."""
    temperature_k: float
    """Temperature around the receiver."""
    other_systems_w: float
    """Median power of other systems at each receiver, which adds to the background noise of receptions,
    not to that of energy detection; 0W: none; prototype mode has no noise."""
    other_systems_standard_deviation_db: float
    """Standard deviation of that power in dB, which is normally distributed and independent at each
    receiver."""
    other_systems_coherence_time_s: float
    """Time after which that power is drawn again, also within a frame."""
    path_loss: str
    """How power falls with distance, and how it fades; docs/how-to/choose-a-propagation-model.md."""
    alpha: float
    """Exponent of the distance."""
    system_loss: float
    """Loss in cables, connectors and filters of sender and receiver together."""
    breakpoint_distance_m: float
    """Distance at which the exponent changes."""
    l01_db: float
    """Loss at 1 m."""
    l02_db: float
    """Loss at the breakpoint."""
    alpha1: float
    """Exponent before the breakpoint."""
    alpha2: float
    """Exponent beyond the breakpoint."""
    epsilon_r: float
    """Relative permittivity of the ground."""
    polarization: str
    """Polarization of the antennas."""
    inet_vertical_sign: bool
    """Whether the ground reflects vertical polarization with the opposite sign, as in INET: far away,
    the rays then add up instead of cancelling."""
    sigma_db: float
    """Standard deviation in dB, as a plain number."""
    k_db: float
    """Power of the line of sight over that of all other paths."""
    shape_factor: float
    """M; the smaller, the deeper the fades."""
    coherence_time_s: float
    """Time from one independent state of a link to the next, at least 1us; 0s: with each frame, as in
    INET; -1s: 5 ms, shadowing 1 s."""
    shadowing_standard_deviation_db: float
    """Standard deviation of the normally distributed gain of each link in dB, beside any path loss and
    fading."""
    shadowing_decorrelation_time_s: float
    """Time from one independent value of that gain to the next, at least 1us; 0s: with each frame."""
    propagation: str
    """How frames travel: at the speed of light."""
    obstacle_loss: str
    """What obstacles do to frames: nothing, block them, or weaken them; not with
    UnitDiskRadioMedium."""
    enable_dielectric_loss: bool
    """Whether the path inside the material weakens a frame."""
    enable_reflection_loss: bool
    """Whether the reflection at each face weakens a frame."""

class ObstacleFields:
    base_m: float
    top_m: float
    material: str
    """What it is made of."""
    relative_permittivity: float
    """Relative permittivity; -1: that of the material."""
    conductivity_spm: float
    """Conductivity in S/m; -1: that of the material."""

class WindFields:
    speed_mps: float
    """Speed of the wind. It acts on vehicles with inertia, QuadcopterMobility and ArdupilotMobility
    (docs/how-to/fly-with-inertia.md)."""
    heading_rad: float
    """Direction in which the air moves, from the x axis to the y axis."""
    gusts_mps: float
    """Standard deviation of the gusts on each axis. Each vehicle has gusts of its own."""
    gust_time_s: float
    """Time in which gusts change: after it, their correlation is 1/e."""

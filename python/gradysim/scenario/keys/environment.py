"""Keys of what stands between the nodes: the model of its losses, and obstacles one by one or as a file."""

from gradysim.scenario.keys.key import HAS_TO_BE_GIVEN, Key
from gradysim.scenario.keys.radio_media import RADIO_MEDIA
from gradysim.scenario.keys.shapes import Below, angle
from gradysim.scenario.parameter_types import boolean, choice, coordinate, integer, number, text

MATERIALS = (
    "concrete",
    "brick",
    "plasterboard",
    "wood",
    "glass",
    "marble",
    "ceilingBoard",
    "chipboard",
    "plywood",
    "metal",
)
"""The names in the engine's table of materials."""

DEFAULT_MATERIAL = "concrete"
"""Of obstacles that do not say theirs."""

_LOSSES = ("IdealObstacleLoss", "DielectricObstacleLoss")

_environment = Below("environment", "environment").only_for("medium.obstacle_loss", *_LOSSES, shown="")
_obstacle = Below("environment.obstacle[0]", "obstacle", _environment.read_by)
_body = _obstacle.only_for("medium.obstacle_loss", "DielectricObstacleLoss")
_loss = Below("radioMedium.obstacleLoss", "medium", RADIO_MEDIA)
_dielectric = _loss.only_for("medium.obstacle_loss", "DielectricObstacleLoss")

NUM_OBSTACLES = _environment(
    "numObstacles",
    "num_obstacles",
    integer(0, 100_000),
    "How many `environment.obstacle[...]` there are",
    default="0",
)

OBSTACLE_FILE = _environment(
    "obstacles",
    "obstacles",
    text(),
    "GeoJSON file with more of them, seen from the .ini file",
    default="none",
)

OBSTACLE_KEYS: tuple[Key, ...] = (
    _obstacle(
        "typename",
        "typename",
        choice("box", "prism"),
        "A box, or any footprint with vertical walls",
        default='"box"',
    ),
    *(
        _obstacle(
            f"{end}{axis}",
            f"{end}_{axis.lower()}",
            coordinate(),
            meaning,
            default=HAS_TO_BE_GIVEN,
        )
        for end, axis, meaning in (
            ("min", "X", "box: its least x, before it is turned"),
            ("max", "X", "box: its largest x"),
            ("min", "Y", "box: its least y"),
            ("max", "Y", "box: its largest y"),
            ("min", "Z", "Height of the floor above z = 0"),
            ("max", "Z", "Height of the roof above z = 0"),
        )
    ),
    _obstacle(
        "heading",
        "heading_rad",
        angle(),
        "box: how it is turned about its middle, from x towards y",
        default="0deg",
    ),
    _obstacle(
        "points",
        "points",
        text(),
        'prism: x and y of the corners in metres, one after the other: "0 0 10 0 10 5"',
        default=HAS_TO_BE_GIVEN,
    ),
    _body(
        "material",
        "material",
        choice(*MATERIALS),
        "what it is made of",
        default=f'"{DEFAULT_MATERIAL}"',
    ),
    _body(
        "relativePermittivity",
        "relative_permittivity",
        number(at_least=1),
        "instead of the material's",
        default="the material's",
    ),
    _body(
        "conductivity",
        "conductivity_spm",
        number(at_least=0),
        "instead of the material's, in S/m",
        default="the material's",
    ),
)
"""Those of one obstacle; in a list of keys it stands for all of them."""

OBSTACLE_LOSS_KEYS: tuple[Key, ...] = (
    _loss(
        "typename",
        "obstacle_loss",
        choice("", *_LOSSES),
        "What obstacles do to frames: nothing, block them, or weaken them; not with UnitDiskRadioMedium",
    ),
    _dielectric(
        "enableDielectricLoss",
        "enable_dielectric_loss",
        boolean(),
        "by the length inside of the material",
    ),
    _dielectric(
        "enableReflectionLoss",
        "enable_reflection_loss",
        boolean(),
        "by the reflection at each face",
    ),
)

ENVIRONMENT_KEYS: tuple[Key, ...] = (*OBSTACLE_LOSS_KEYS, OBSTACLE_FILE, NUM_OBSTACLES, *OBSTACLE_KEYS)


def obstacle_path(key: Key, index: int) -> str:
    """The path of a key of OBSTACLE_KEYS for one obstacle."""
    return key.path.replace("[0]", f"[{index}]", 1)

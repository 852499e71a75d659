"""Keys of what stands between the nodes: the model of its losses, and obstacles one by one or as a file."""

from gradysim.config.key import Key
from gradysim.config.keys.shapes import Below, angle
from gradysim.config.kinds import boolean, choice, coordinate, integer, number, text

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
"""The engine's."""

_environment = Below("environment", "environment")
_obstacle = Below("environment.obstacle[0]", "obstacle")
_loss = Below("radioMedium.obstacleLoss", "medium")

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
            default="none: it has to be given",
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
        default="none: it has to be given",
    ),
    _obstacle(
        "material",
        "material",
        choice(*MATERIALS),
        "DielectricObstacleLoss: what it is made of",
        default='"concrete"',
    ),
    _obstacle(
        "relativePermittivity",
        "relative_permittivity",
        number(at_least=1),
        "DielectricObstacleLoss: instead of the material's",
        default="the material's",
    ),
    _obstacle(
        "conductivity",
        "conductivity_spm",
        number(at_least=0),
        "DielectricObstacleLoss: instead of the material's, in S/m",
        default="the material's",
    ),
)
"""Those of one obstacle; in a list of keys it stands for all of them."""

OBSTACLE_LOSS_KEYS: tuple[Key, ...] = (
    _loss(
        "typename",
        "obstacle_loss",
        choice("", "IdealObstacleLoss", "DielectricObstacleLoss"),
        "What obstacles do to frames: nothing, block them, or weaken them; not with UnitDiskRadioMedium",
    ),
    _loss(
        "enableDielectricLoss",
        "enable_dielectric_loss",
        boolean(),
        "DielectricObstacleLoss: by the length inside of the material",
    ),
    _loss(
        "enableReflectionLoss",
        "enable_reflection_loss",
        boolean(),
        "DielectricObstacleLoss: by the reflection at each face",
    ),
)

ENVIRONMENT_KEYS: tuple[Key, ...] = (*OBSTACLE_LOSS_KEYS, OBSTACLE_FILE, NUM_OBSTACLES, *OBSTACLE_KEYS)


def obstacle_path(key: Key, index: int) -> str:
    """The path of a key of OBSTACLE_KEYS for one obstacle."""
    return key.path.replace("[0]", f"[{index}]", 1)

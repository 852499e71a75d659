"""The folder of --result-dir: made and tried before a run that takes hours finds out that it cannot be."""

import os
from pathlib import Path


def make_result_dir(directory: Path) -> None:
    """Make the folder of --result-dir. Raises ConfigError, which names the option."""
    from gradysim.config.errors.config_error import ConfigError

    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = "it is no folder" if os.path.lexists(directory) else error.strerror or str(error)
        raise ConfigError(f"--result-dir {directory}: {reason}; expected a folder, or a new name") from error


def check_may_be_written_to(directory: Path) -> None:
    """Raise ConfigError, which names the option, if no file can be made in it."""
    from gradysim.config.errors.config_error import ConfigError

    if not os.access(directory, os.W_OK | os.X_OK):
        raise ConfigError(f"--result-dir {directory}: it takes no files from you; expected another folder")

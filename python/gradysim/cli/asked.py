"""What `gradysim run` was asked to write and to tell of each run, beyond its summary."""

from dataclasses import dataclass
from pathlib import Path

DEFAULT_DIR = Path("results")


@dataclass(frozen=True)
class Asked:
    """The values of the options."""

    result_dir: Path | None = None
    pcap: tuple[str, ...] = ()
    fates_at: tuple[str, ...] = ()
    scalars: bool = False
    vectors: tuple[str, ...] = ()

    @property
    def directory(self) -> Path:
        """Where all files go."""
        return DEFAULT_DIR if self.result_dir is None else self.result_dir

    @property
    def writes_files(self) -> bool:
        """Whether the folder has to be there before the runs; captures make it themselves."""
        return self.result_dir is not None or self.scalars or bool(self.vectors)

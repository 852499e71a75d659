"""Both modes of the consensus."""

import pytest

from gradysim.protocol.plugin.raft import RaftMode

BOTH_MODES = pytest.mark.parametrize("mode", RaftMode)

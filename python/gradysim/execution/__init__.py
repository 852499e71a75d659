"""Execution of scenarios, the same in both modes, in a directory that other processes may use, too.

`scenario_run` advances a run and makes its result, with the log lines of `run_log`. Because of `run_lock`,
two processes never compute the same run, and `packing` never packs a result that is being written.
"""

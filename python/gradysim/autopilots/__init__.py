"""The nodes of a scenario that autopilots fly, for both modes."""

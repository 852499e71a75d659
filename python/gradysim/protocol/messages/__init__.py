"""What passes between a protocol and its node: commands go down, telemetry comes up."""

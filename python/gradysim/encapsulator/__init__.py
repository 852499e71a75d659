"""The glue between one protocol and one environment."""

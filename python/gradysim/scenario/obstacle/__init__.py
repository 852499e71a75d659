"""The obstacles of a scenario as plain data, and how they are read from .ini and GeoJSON files."""

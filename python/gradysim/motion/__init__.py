"""Motion of vehicles: their physics, their built-in controller, the wind, and errors of their positions."""

"""Shows a simulation in a web page: the server side of the viewer."""

from gradysim.simulator.handler.visualization.handler import VisualizationHandler
from gradysim.simulator.handler.visualization.messages import VisualizationConfiguration
from gradysim.simulator.handler.visualization.server import VisualizationException

__all__ = ["VisualizationConfiguration", "VisualizationException", "VisualizationHandler"]

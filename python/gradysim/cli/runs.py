"""`gradysim runs`: the runs of a configuration."""

from gradysim.cli.arguments import ConfigOption, FileArgument, SetOption
from gradysim.cli.exit_code import OK, say_mistake
from gradysim.cli.scenarios import check
from gradysim.cli.warnings import tell


def list_runs(file: FileArgument, /, *, config: ConfigOption = "General", settings: SetOption = ()) -> int:
    """List the runs of a configuration."""
    from gradysim.scenario.errors.config_error import ConfigError
    from gradysim.scenario.lint import unread_variables
    from gradysim.scenario.sweep import text_of_iterations

    try:
        scenarios = check(file, config, None, settings).scenarios
        tell(unread_variables(scenarios[0].unread_variables, scenarios[0].lines))
        for scenario in scenarios:
            values = {**scenario.iterations, "repetition": scenario.repetition}
            print(f"Run {scenario.run_number}: {text_of_iterations(values)}")
    except ConfigError as mistake:
        return say_mistake(mistake)
    return OK

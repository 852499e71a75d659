"""The command `gradysim`: its subcommands, their options and what they print. `app` is the entry point."""

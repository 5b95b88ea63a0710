"""The subcommands of `trg`, one module each: `add_parser(subparsers)` and `run(args) -> int`."""

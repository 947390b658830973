"""The command line: parses, calls, prints. No algorithm lives here, and nothing heavy is imported before a command runs."""

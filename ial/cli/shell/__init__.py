"""What all commands share: options, files that are written, what people see, and the exit status."""

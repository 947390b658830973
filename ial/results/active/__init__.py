"""What a robot that drives in order to be localized leaves on disk besides."""

"""Bounds, precision and limits: what a user says, and the form in which files hold it."""

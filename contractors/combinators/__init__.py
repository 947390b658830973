"""Contractors and separators made of others."""

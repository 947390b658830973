"""Contractors for relations of plane geometry."""

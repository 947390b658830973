"""Problems of several constraints, and the zeros of systems."""

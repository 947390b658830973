"""What a robot may know after each stream of bumps, compiled: from a labelled graph to the smallest deterministic automaton."""

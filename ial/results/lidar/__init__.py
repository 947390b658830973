"""A run of the localizer on disk: trajectory, enclosures, events, summary, picture and a recording to look at."""

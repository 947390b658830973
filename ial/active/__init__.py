"""Where to drive next in order to be localized. Names are loaded when they are first used."""

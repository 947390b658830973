"""Keys of configurations: each is described once, and checks, files, variables and pages follow from that.

A configuration is a frozen dataclass on `Record`. Each of its fields says in its metadata, by `key`, what it means, in which unit, and
which values it may have; nothing else needs to know it. After a change in the localizer's keys, `python docs/keys.py` writes their table.

It rests on no library: msgspec and attrs each take 50 ms and 1 MB to load, which a robot would pay at
every start; msgspec's `Struct` stops at the first fault, does not name its value, and lets a wrong one pass where Python makes the object.
"""

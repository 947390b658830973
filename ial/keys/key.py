"""`Key`: all that there is to say about one key of a configuration, but its name and its default."""

from dataclasses import dataclass

from ial.keys.kind import Kind


@dataclass(frozen=True)
class Key:
    """The description of a key; its name and its default are those of the field of the dataclass.

    Parameters
    ----------
    kind
        Which values it may have.
    means
        What it means, as a sentence without its capital and its full stop.
    unit
        The unit; "{}" in it stands for that of the part that the key belongs to.
    """

    kind: Kind
    means: str
    unit: str = ""

    @property
    def sentence(self) -> str:
        """What it means, in which unit, and which values it may have."""
        unit = "" if "{" in self.unit else self.unit
        about = ", ".join(filter(None, (unit, self.kind.brief)))
        return f"{self.means[0].upper()}{self.means[1:]}{f' ({about})' if about else ''}."


def key(kind: Kind, means: str, unit: str = "") -> dict[str, Key]:
    """Return the metadata of a field that is a key; see `Key`."""
    return {"key": Key(kind, means, unit)}

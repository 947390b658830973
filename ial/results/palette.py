"""The colours of a run, the same in the picture and in the recording; readable without telling red from green."""

STATUS_COLOURS = {
    "localized": "#1b6ca8",
    "symmetric": "#6f4e9c",
    "ambiguous": "#e8a33d",
    "lost": "#c1121f",
    "blind": "#5c0a12",
}
PREDICTION = "#8d99ae"
FOUND = "#c1121f"
PATH = "#0b2545"
TRUTH = "#d1495b"
VANISHING = "#e4007c"
ON_WALL = "#1b9e77"
OFF_WALL = "#d1495b"
FREE, OCCUPIED, UNKNOWN = "#ffffff", "#22262b", "#e6e9ed"
EDGE = "#9aa3ad"
HYPOTHESES = ("#1b6ca8", "#e8a33d", "#1b9e77", "#6f4e9c", "#7a5230", "#4aa8c9", "#8f9e2e", "#c77cba")
"""Of places that are told apart; more of them begin anew."""


def rgb(colour: str) -> tuple[float, float, float]:
    """Return red, green and blue of ``#rrggbb``, each from 0 to 1."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue

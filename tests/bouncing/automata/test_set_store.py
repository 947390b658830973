import random

import numpy as np

from ial.bouncing.automata.set_store import SetStore


def test_the_smallest_set_that_holds_another_one_is_found() -> None:
    chooser = random.Random(0)
    store, kept = SetStore(130), []
    found = 0
    for _ in range(600):
        some = {chooser.randrange(130) for _ in range(chooser.choice([1, 5, 20, 125]))}
        wanted = some | set(chooser.choice(kept)[0] if kept and chooser.random() < 0.5 else ())
        wanted = {each for each in wanted if chooser.random() < 0.9} or {0}
        colour, most = chooser.choice([1, 2]), chooser.randrange(130)
        vertices = np.array(chooser.sample(sorted(wanted), len(wanted)), dtype=np.int32)
        fitting = [(len(held), at) for at, (held, its) in enumerate(kept) if its == colour and len(held) <= most and wanted <= held]
        assert store.find(vertices, colour, most) == (min(fitting)[1] if fitting else -1)
        found += bool(fitting)
        assert store.add(vertices, colour) == len(kept)
        kept.append((frozenset(wanted), colour))
    assert found > 100
    assert len(store) == 600
    assert store.sizes.tolist() == [len(held) for held, _ in kept]
    assert store.colours.tolist() == [colour for _, colour in kept]
    assert store.colour(7) == kept[7][1]

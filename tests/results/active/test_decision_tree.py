from ial.active.decision import Decision
from ial.results.active.decision_tree import DecisionTree
from tests.results.active.legs import driven, leg


def tree(*decisions: Decision) -> DecisionTree:
    grown = DecisionTree()
    grown.add(leg(0))
    for number, decision in enumerate(decisions, 1):
        grown.add(leg(number, decision))
    return grown


def test_what_goes_on_belongs_to_what_began_it() -> None:
    nodes = tree(driven("direction"), driven("direction", goes_on=True), driven("frontier", since=3)).nodes
    assert [(each.first, each.stage, each.drives, each.parent, each.lane) for each in nodes] == [
        (0, "first look", 0, None, 0),
        (1, "direction", 2, 0, 0),
        (3, "frontier", 1, 1, 0),
    ]
    assert {each.hypotheses for each in nodes} == {leg(0).hypotheses}


def test_a_robot_that_drives_back_begins_a_new_row_where_the_frontier_was_first_known() -> None:
    grown = tree(
        driven("frontier", since=1, open=(1,)),
        driven("frontier", goes_on=True, open=(1,)),
        driven("frontier", since=3, open=(1, 3)),
        driven("backtrack", since=3, open=(1,)),
        driven("backtrack", since=1),
    )
    assert [(each.first, each.parent, each.lane) for each in grown.nodes] == [(0, None, 0), (1, 0, 0), (3, 1, 0), (4, 1, 1), (5, 0, 2)]


def test_leaves_hang_where_frontiers_that_are_left_at_the_end_were_first_known() -> None:
    grown = tree(driven("frontier", since=1, open=(1, 1)), driven("frontier", since=2, open=(1, 2, 2)))
    assert [each.left for each in grown.nodes] == [1, 2, 0]


def test_the_end_of_a_search_is_a_node_without_drives() -> None:
    *_, last = tree(driven("view"), Decision(None, "exhausted", "nothing is left")).nodes
    assert (last.stage, last.drives, last.parent) == ("exhausted", 0, 1)


def test_collisions_are_counted() -> None:
    grown = tree(driven("random"))
    grown.add(leg(2, driven("random", goes_on=True), collided=True))
    assert [each.collisions for each in grown.nodes] == [0, 1]

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.minimal import minimize
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.planning.trace_classes import trace_classes, trace_quotient
from tests.bouncing.worlds import cell_map, observations, random_mask


def test_trace_classes_are_those_of_equal_observations() -> None:
    graph = cell_map(random_mask(2, 5, 5), 90, 8).graph
    traces = [tuple(observations(graph, vertex, 2 * len(graph))[0]) for vertex in range(len(graph))]
    names: dict[tuple[int, ...], int] = {}
    assert trace_classes(graph).tolist() == [names.setdefault(trace, len(names)) for trace in traces]


def test_the_quotient_accepts_the_same_streams() -> None:
    graph = cell_map(random_mask(2, 6, 6), 90, 24).graph
    quotient, classes = trace_quotient(graph)
    assert isinstance(quotient, LabelledGraph)
    assert len(quotient) < len(graph)
    whole, small = FilterTable.of(determinize(graph)), FilterTable.of(determinize(quotient))
    assert len(small) <= len(whole)
    assert (minimize(whole, "localized").successors == minimize(small, "localized").successors).all()
    assert quotient.labels[classes].tolist() == graph.labels.tolist()

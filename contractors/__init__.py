"""Intervals, expressions, contractors, separators and pavers: set computation with outward rounding, which knows no robot."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.contractors.algebra import intersection as intersection
    from ial.contractors.algebra import lazy as lazy
    from ial.contractors.algebra import negation as negation
    from ial.contractors.algebra import relaxed as relaxed
    from ial.contractors.algebra import union as union
    from ial.contractors.boxes import Boxes as Boxes
    from ial.contractors.combinators.affine import Affine as Affine
    from ial.contractors.combinators.combination import Intersection as Intersection
    from ial.contractors.combinators.combination import Union as Union
    from ial.contractors.combinators.cylinder import where as where
    from ial.contractors.combinators.family import Family as Family
    from ial.contractors.combinators.fixed_point import fixpoint as fixpoint
    from ial.contractors.combinators.preimage import transform as transform
    from ial.contractors.combinators.projector import projection as projection
    from ial.contractors.combinators.relaxation import Relaxed as Relaxed
    from ial.contractors.combinators.relaxation import relaxed_intersection as relaxed_intersection
    from ial.contractors.contractor import Contractor as Contractor
    from ial.contractors.contractor import ContractorLike as ContractorLike
    from ial.contractors.expressions.constraint import Constraint as Constraint
    from ial.contractors.expressions.constraint import ConstraintFamily as ConstraintFamily
    from ial.contractors.expressions.expression import Expression as Expression
    from ial.contractors.expressions.function import Function as Function
    from ial.contractors.expressions.function_family import FunctionFamily as FunctionFamily
    from ial.contractors.expressions.functions import absolute as absolute
    from ial.contractors.expressions.functions import acos as acos
    from ial.contractors.expressions.functions import acosh as acosh
    from ial.contractors.expressions.functions import add as add
    from ial.contractors.expressions.functions import asin as asin
    from ial.contractors.expressions.functions import asinh as asinh
    from ial.contractors.expressions.functions import atan as atan
    from ial.contractors.expressions.functions import atan2 as atan2
    from ial.contractors.expressions.functions import atanh as atanh
    from ial.contractors.expressions.functions import ceil as ceil
    from ial.contractors.expressions.functions import cos as cos
    from ial.contractors.expressions.functions import cosh as cosh
    from ial.contractors.expressions.functions import div as div
    from ial.contractors.expressions.functions import exp as exp
    from ial.contractors.expressions.functions import exp2 as exp2
    from ial.contractors.expressions.functions import exp10 as exp10
    from ial.contractors.expressions.functions import floor as floor
    from ial.contractors.expressions.functions import hypot as hypot
    from ial.contractors.expressions.functions import log as log
    from ial.contractors.expressions.functions import log2 as log2
    from ial.contractors.expressions.functions import log10 as log10
    from ial.contractors.expressions.functions import maximum as maximum
    from ial.contractors.expressions.functions import minimum as minimum
    from ial.contractors.expressions.functions import mul as mul
    from ial.contractors.expressions.functions import multiply_add as multiply_add
    from ial.contractors.expressions.functions import neg as neg
    from ial.contractors.expressions.functions import pow as pow
    from ial.contractors.expressions.functions import pown as pown
    from ial.contractors.expressions.functions import recip as recip
    from ial.contractors.expressions.functions import rootn as rootn
    from ial.contractors.expressions.functions import round_ties_to_away as round_ties_to_away
    from ial.contractors.expressions.functions import round_ties_to_even as round_ties_to_even
    from ial.contractors.expressions.functions import sign as sign
    from ial.contractors.expressions.functions import sin as sin
    from ial.contractors.expressions.functions import sinh as sinh
    from ial.contractors.expressions.functions import sqr as sqr
    from ial.contractors.expressions.functions import sqrt as sqrt
    from ial.contractors.expressions.functions import sub as sub
    from ial.contractors.expressions.functions import tan as tan
    from ial.contractors.expressions.functions import tanh as tanh
    from ial.contractors.expressions.functions import trunc as trunc
    from ial.contractors.expressions.mean_value import mean_value as mean_value
    from ial.contractors.expressions.operation import Operation as Operation
    from ial.contractors.expressions.variables import variables as variables
    from ial.contractors.geometry.annulus import Annulus as Annulus
    from ial.contractors.geometry.coordinates import from_polar as from_polar
    from ial.contractors.geometry.coordinates import to_polar as to_polar
    from ial.contractors.geometry.distance import Distance as Distance
    from ial.contractors.geometry.point_cloud import PointCloud as PointCloud
    from ial.contractors.geometry.polar import Polar as Polar
    from ial.contractors.geometry.polygon import Polygon as Polygon
    from ial.contractors.geometry.range_bearing import RangeBearing as RangeBearing
    from ial.contractors.geometry.segment import Segment as Segment
    from ial.contractors.geometry.segment import Segments as Segments
    from ial.contractors.intervals.conversion import from_crival as from_crival
    from ial.contractors.intervals.conversion import from_pyinterval as from_pyinterval
    from ial.contractors.intervals.conversion import to_crival as to_crival
    from ial.contractors.intervals.conversion import to_pyinterval as to_pyinterval
    from ial.contractors.intervals.interval import Interval as Interval
    from ial.contractors.intervals.narrowing import divide_pieces as divide_pieces
    from ial.contractors.intervals.narrowing import narrow as narrow
    from ial.contractors.paving.clusters import Clusters as Clusters
    from ial.contractors.paving.clusters import cluster as cluster
    from ial.contractors.paving.minimal_outliers import MinimalOutliers as MinimalOutliers
    from ial.contractors.paving.minimal_outliers import minimal_outliers as minimal_outliers
    from ial.contractors.paving.paver import pave as pave
    from ial.contractors.paving.paving import Paving as Paving
    from ial.contractors.paving.smear import smear as smear
    from ial.contractors.rounding import check_rounding as check_rounding
    from ial.contractors.separator import Separator as Separator
    from ial.contractors.solving.newton import Newton as Newton
    from ial.contractors.solving.problem import Problem as Problem
    from ial.contractors.solving.zeros import certify as certify
    from ial.contractors.solving.zeros import zeros as zeros
    from ial.contractors.threads import get_threads as get_threads
    from ial.contractors.threads import set_threads as set_threads
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "algebra": ("intersection", "lazy", "negation", "relaxed", "union"),
            "boxes": ("Boxes",),
            "combinators.affine": ("Affine",),
            "combinators.combination": ("Intersection", "Union"),
            "combinators.cylinder": ("where",),
            "combinators.family": ("Family",),
            "combinators.fixed_point": ("fixpoint",),
            "combinators.preimage": ("transform",),
            "combinators.projector": ("projection",),
            "combinators.relaxation": ("Relaxed", "relaxed_intersection"),
            "contractor": ("Contractor", "ContractorLike"),
            "expressions.constraint": ("Constraint", "ConstraintFamily"),
            "expressions.expression": ("Expression",),
            "expressions.function": ("Function",),
            "expressions.function_family": ("FunctionFamily",),
            "expressions.functions": (
                "absolute",
                "acos",
                "acosh",
                "add",
                "asin",
                "asinh",
                "atan",
                "atan2",
                "atanh",
                "ceil",
                "cos",
                "cosh",
                "div",
                "exp",
                "exp10",
                "exp2",
                "floor",
                "hypot",
                "log",
                "log10",
                "log2",
                "maximum",
                "minimum",
                "mul",
                "multiply_add",
                "neg",
                "pow",
                "pown",
                "recip",
                "rootn",
                "round_ties_to_away",
                "round_ties_to_even",
                "sign",
                "sin",
                "sinh",
                "sqr",
                "sqrt",
                "sub",
                "tan",
                "tanh",
                "trunc",
            ),
            "expressions.mean_value": ("mean_value",),
            "expressions.operation": ("Operation",),
            "expressions.variables": ("variables",),
            "geometry.annulus": ("Annulus",),
            "geometry.coordinates": ("from_polar", "to_polar"),
            "geometry.distance": ("Distance",),
            "geometry.point_cloud": ("PointCloud",),
            "geometry.polar": ("Polar",),
            "geometry.polygon": ("Polygon",),
            "geometry.range_bearing": ("RangeBearing",),
            "geometry.segment": ("Segment", "Segments"),
            "intervals.conversion": ("from_crival", "from_pyinterval", "to_crival", "to_pyinterval"),
            "intervals.interval": ("Interval",),
            "intervals.narrowing": ("divide_pieces", "narrow"),
            "paving.clusters": ("Clusters", "cluster"),
            "paving.minimal_outliers": ("MinimalOutliers", "minimal_outliers"),
            "paving.paver": ("pave",),
            "paving.paving": ("Paving",),
            "paving.smear": ("smear",),
            "rounding": ("check_rounding",),
            "separator": ("Separator",),
            "solving.newton": ("Newton",),
            "solving.problem": ("Problem",),
            "solving.zeros": ("certify", "zeros"),
            "threads": ("get_threads", "set_threads"),
        },
    )

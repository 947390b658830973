"""`KernelDispatcher`: compiles a kernel for those who call it, Python or other kernels.

What a kernel calls becomes a part of it. So of a kernel inside kernels neither machine code nor a wrapper that unpacks Python's objects is
ever used, and it need not be optimized by itself, since its callers are, as a whole. Without all this a kernel takes much less time to
compile. One that Python calls as well is compiled a second time, when Python calls it.
"""

from typing import Any

import llvmlite.binding as llvm
from numba.core.caching import NullCache
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, CompileResult, compile_result
from numba.core.dispatcher import _FunctionCompiler  # type: ignore[attr-defined]
from numba.core.environment import lookup_environment
from numba.core.registry import CPUDispatcher


class KernelDispatcher(CPUDispatcher):  # type: ignore[misc]
    """Compiles a kernel when Python or another kernel calls it; Numba's interface of a dispatcher.

    Attributes
    ----------
    inlined
        The code that becomes a part of other kernels.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.inlined = _InlinedDispatcher(*arguments, **options)
        self.inlined._compiling_counter = self._compiling_counter  # by which Numba sees that a kernel calls itself

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Return what a caller that is being compiled needs to know, before all the type of the result."""
        return self.inlined.get_call_template(args, kws)

    def get_overload(self, sig: Any) -> Any:
        """Return the key of the code for such types that becomes a part of a caller."""
        return self.inlined.get_overload(sig)

    def add_overload(self, cres: CompileResult) -> None:
        """Keep the code for some types, which Python will call."""
        super().add_overload(cres)
        set_environments(cres.library)


def set_environments(library: JITCodeLibrary) -> None:
    """Tell code that was just compiled where the Python objects are that the kernels inside it refer to; code that was kept knows it."""
    for variable in library._final_module.global_variables:
        if (environment := lookup_environment(variable.name)) is not None:
            library.codegen.set_env(variable.name, environment)


class _InlinedDispatcher(CPUDispatcher):  # type: ignore[misc]
    """Compiles a kernel for the kernels that call it. What Numba calls the entry point of the code is here no more than its key."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._compiler = _InlinedCompiler(self.py_func, self.targetdescr, self.targetoptions, self.locals, _InlinedPipeline)
        self._cache = NullCache()

    def add_overload(self, cres: CompileResult) -> None:
        """Keep the code for some types, which Python never calls."""
        self.overloads[tuple(cres.signature.args)] = cres


class _InlinedCompiler(_FunctionCompiler):  # type: ignore[misc]
    """Compiles into LLVM's language."""

    def _customize_flags(self, flags: Any) -> Any:
        flags.no_cpython_wrapper = True
        flags.no_compile = True
        return flags

    def _compile_core(self, args: Any, return_type: Any) -> CompileResult:
        result = super()._compile_core(args, return_type)._replace(entry_point=object())
        result.target_context.insert_user_function(result.entry_point, result.fndesc, [result.library])
        return result


class _InlinedPipeline(Compiler):  # type: ignore[misc]
    """Numba's steps from Python's bytecode to a library."""

    def __init__(self, typingctx: Any, targetctx: Any, library: None, *rest: Any) -> None:
        super().__init__(typingctx, targetctx, InlinedLibrary(targetctx.codegen(), "inlined"), *rest)


class InlinedLibrary(JITCodeLibrary):  # type: ignore[misc]
    """The code of a kernel, and beside it that of the kernels that it calls, in LLVM's language; it is never made ready to run."""

    def _optimize_final_module(self) -> None:
        """Leave it as it is: it will be optimized as a part of its callers."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True

    def serialize_using_object_code(self) -> Any:
        """Return what `rebuild_inlined` makes a library of."""
        return self.serialize_using_bitcode()


def rebuild_inlined(target_context: Any, library_state: Any, *others: Any) -> CompileResult:
    """Return what ``CompileResult._reduce`` has taken apart, as its ``_rebuild`` does for code that runs."""
    name, _, bitcode = library_state
    library = InlinedLibrary(target_context.codegen(), name)
    library._final_module = llvm.parse_bitcode(bitcode)
    library._finalize_final_module()
    names = "fndesc", "environment", "signature", "objectmode", "lifted", "type_annotation", "reload_init", "referenced_envs"
    return compile_result(
        target_context=target_context,
        typing_context=target_context.typing_context,
        library=library,
        entry_point=object(),
        **dict(zip(names, others, strict=True)),
    )

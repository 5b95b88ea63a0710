"""The helpers that translated code calls by their one-letter names."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import compress
from types import FunctionType, GeneratorType

from .bind import HOST, make_invoker
from .exports import parameter_value
from .lists import List
from .runtime import Place, Runtime
from .values import Obj, Str, TrgError, Undef, trg_frame, type_name
from .vector import Vec3

PAUSE = object()
"""What a program yields between two slices."""
_ABSENT = object()


class Helpers:
    """The helpers of one run."""

    def __init__(self, rt: Runtime) -> None:
        self.rt = rt
        self._takes_self = {
            f"f_{index}" for index, facts in enumerate(rt.program.functions) if facts.takes_self
        }

    def table(self) -> dict[str, object]:
        """The globals that translated code starts from."""
        rt = self.rt
        made: dict[str, object] = {"__builtins__": {}}
        made.update((f"g_{name}", rt.undef) for name in rt.program.global_names)
        made.update(HOST.bind(rt))
        for (builtin, span), name in rt.program.places.items():
            made[name] = make_invoker(rt, HOST.functions[builtin], Place(rt, builtin, span))
        made.update((name, rt.text(text)) for text, name in rt.program.strings.items())
        made.update(t_num=float, t_str=Str, t_vec3=Vec3, t_list=List, t_object=Obj)
        made.update(
            u_=rt.undef, A_=_ABSENT, P_=PAUSE, G_=GeneratorType, Y_=type, S_=iter(()), T_=rt.take_step,
            B_=self.set_after, E_=self.set_field, D_=self.is_defined, F_=self.function, L_=rt.compare,
            M_=self.method, N_=rt.logical_not, O_=Obj, R_=self.missing, W_=self.check_type,
            Z_=self.counted, K_=rt.ticks(), C_=compress, H_=self.new_list, I_=self.elements,
            J_=self.set_element, Q_=next, V_=self.parameter,
        )  # fmt: skip
        return made

    def set_field(self, holder: object, name: str, value: object) -> object:
        """`holder.name = value` as an expression."""
        setattr(holder, name, value)
        return value

    def set_after(self, holder: object, name: str, old: object, new: object) -> object:
        """`holder.name++` as an expression: its value is the old one."""
        setattr(holder, name, new)
        return old

    def new_list(self, elements: tuple[object, ...]) -> List:
        """`[a, b]`."""
        return List(self.rt, list(elements))

    def set_element(self, value: object, holder: object, index: object) -> object:
        """`holder[index] = value` as an expression."""
        holder[index] = value  # type: ignore[index]
        return value

    def parameter(self, name: str) -> object:
        """The host's value of an exported parameter, or its default."""
        rt = self.rt
        value = parameter_value(rt.program.exports[name], rt.options.parameters)
        if isinstance(value, str):
            return rt.text(value)
        return Vec3.of(*value) if isinstance(value, tuple) else value

    def elements(self, subject: object) -> Iterator[object]:
        """What `for (x in subject)` goes over: the list as it is at every turn."""
        if type(subject) is not List:
            raise TrgError("E444", operand=0, kind=type_name(subject))
        return iter(subject.items)

    def is_defined(self, holder: object, name: str) -> float:
        """`isdef(holder.name)`."""
        found = getattr(holder, name, self.rt.undef)
        return 0.0 if type(found) is Undef else 1.0

    def function(self, code: FunctionType) -> FunctionType:
        """A function value of its own, with its own fields."""
        return FunctionType(code.__code__, code.__globals__, code.__name__, code.__defaults__)

    def method(self, holder: object, function: object) -> object:
        """The function in a field, bound to its object when its first parameter is `self`."""
        if type(function) is not FunctionType or function.__code__.co_name not in self._takes_self:
            return function
        if type(holder) is not Obj:
            return function

        def bound(depth: int, *arguments: object) -> object:
            return function(depth, holder, *arguments)

        return bound

    def missing(self, parameter: str) -> None:
        raise TrgError("E432", name=self._running(), parameter=parameter)

    def check_type(self, value: object, parameter: str, wanted: str) -> None:
        """Raise TrgError unless `typeof(value)` is `wanted`."""
        kind = type_name(value)
        if kind != wanted:
            raise TrgError("E434", name=parameter, wanted=wanted, kind=kind)

    def counted(self, value: object) -> object:
        """The old value of `x++`: a variable without one counts as 0."""
        if type(value) is not Undef:
            return value
        self.rt.warn_undefined(0)
        return 0.0

    def _running(self) -> str:
        frame = trg_frame(self.rt.globals)
        name = "" if frame is None else frame.f_code.co_name
        return self.rt.program.function_name(name) if name.startswith("f_") else "function"

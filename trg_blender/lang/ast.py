"""The syntax tree of a program: nodes that never change, each with its span.

`depth` of an expression bounds the depth of the Python tree made from it: the parser keeps it
below a limit, so that no later phase can exhaust a stack.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeVar, dataclass_transform, get_args

from .source import Span

Made = TypeVar("Made")


@dataclass_transform(frozen_default=True)
def _node(made: type[Made]) -> type[Made]:
    """A dataclass that the type checker keeps frozen.

    Python does not: that makes a node four times as slow to construct, and a long program has
    hundreds of thousands.
    """
    return dataclass(slots=True)(made)


@_node
class Number:
    span: Span
    value: float
    depth: int = 1


@_node
class String:
    span: Span
    text: str
    depth: int = 1


@_node
class Path:
    """`name`, `#name`, `space::name`; `name` holds the parts joined by `::`."""

    span: Span
    name: str
    hashed: bool = False
    depth: int = 1

    @property
    def is_global(self) -> bool:
        return self.hashed or "::" in self.name


@_node
class Unary:
    span: Span
    op: str
    operand: Expr
    depth: int


@_node
class Binary:
    """Arithmetic and comparison; `op_span` is the operator itself."""

    span: Span
    op: str
    left: Expr
    right: Expr
    depth: int


@_node
class Logic:
    """`&&` and `||`."""

    span: Span
    op: str
    left: Expr
    right: Expr
    depth: int


@_node
class Assign:
    """`op` is `=`, `+=`, `-=`, `*=`, `/=` or `%=`."""

    span: Span
    op: str
    target: Target
    value: Expr
    depth: int


@_node
class Step:
    """`++` and `--`, before or after the target."""

    span: Span
    op: str
    prefix: bool
    target: Target
    depth: int


@_node
class Call:
    span: Span
    callee: Expr
    arguments: tuple[Expr, ...]
    depth: int


@_node
class Field:
    """`object.name`; the name of an operator field is `operator+` and so on."""

    span: Span
    object: Expr
    name: str
    depth: int


@_node
class Index:
    """`object[index]`."""

    span: Span
    object: Expr
    index: Expr
    depth: int


@_node
class ListOf:
    """`[a, b]`."""

    span: Span
    elements: tuple[Expr, ...]
    depth: int


@_node
class Each:
    """`target in subject`, the head of a loop over a list; it stands nowhere else."""

    span: Span
    target: Path
    subject: Expr
    depth: int


@_node
class Parameter:
    span: Span
    name: str
    default: Expr | None
    type_name: str | None
    type_span: Span | None


@_node
class Function:
    """A function value. `name` is what it is assigned to, for messages."""

    span: Span
    parameters: tuple[Parameter, ...]
    body: Block
    name: str = ""
    depth: int = 1


@_node
class ExprStatement:
    span: Span
    value: Expr


@_node
class Block:
    span: Span
    statements: tuple[Statement, ...]


@_node
class If:
    """The branches of one `if ... else if ...` chain in order, then the last `else`."""

    span: Span
    branches: tuple[tuple[Expr, Statement], ...]
    otherwise: Statement | None


@_node
class While:
    """`span` is the keyword."""

    span: Span
    condition: Expr
    body: Statement


@_node
class For:
    """`span` is the keyword."""

    span: Span
    init: Expr | None
    condition: Expr | None
    step: Expr | None
    body: Statement


@_node
class ForEach:
    """`for (x in list)`. `span` is the keyword."""

    span: Span
    head: Each
    body: Statement


@_node
class Case:
    """`value` is None for `default`."""

    span: Span
    value: Expr | None
    body: tuple[Statement, ...]


@_node
class Switch:
    span: Span
    subject: Expr
    cases: tuple[Case, ...]


@_node
class Include:
    span: Span
    name: str
    name_span: Span


@_node
class Export:
    """`export name = default ~ "type" ~ range(low, high);`: a variable that the host may set.

    `assignment` is the first part; `limits` the call behind the last `~`.
    """

    span: Span
    assignment: Assign
    type_name: str | None
    type_span: Span | None
    limits: Call | None


@_node
class Break:
    span: Span


@_node
class Continue:
    span: Span


@_node
class Return:
    span: Span
    value: Expr | None


Target = Path | Field | Index
"""What can be assigned to."""
Expr = (
    Number | String | Path | Unary | Binary | Logic | Assign | Step | Call | Field | Index | ListOf
    | Each | Function
)  # fmt: skip
Statement = (
    ExprStatement | Block | If | While | For | ForEach | Switch | Include | Export | Break | Continue
    | Return
)  # fmt: skip
STATEMENTS = get_args(Statement)
_STATEMENTS = frozenset(STATEMENTS)
_LEAVES = frozenset((Number, String, Path, Function))
ASSIGNING = (Assign, Step, Each)


@_node
class FileTree:
    """One source file. `includes` maps the place of an include to the file it runs, once."""

    name: str
    statements: tuple[Statement, ...]
    includes: dict[Span, str] = field(default_factory=dict)


def child_expressions(node: Expr) -> tuple[Expr, ...]:
    """The direct operands of an expression, in order of evaluation; not the body of a function."""
    match node:
        case Unary():
            return (node.operand,)
        case Binary() | Logic():
            return (node.left, node.right)
        case Assign():
            return (node.target, node.value)
        case Step():
            return (node.target,)
        case Call():
            return (node.callee, *node.arguments)
        case Field():
            return (node.object,)
        case Index():
            return (node.object, node.index)
        case ListOf():
            return node.elements
        case Each():
            return (node.target, node.subject)
    return ()


def parts_of(node: Statement) -> tuple[tuple[Expr, ...], tuple[Statement, ...]]:
    """The direct expressions and the direct statements of a statement."""
    match node:
        case ExprStatement():
            return (node.value,), ()
        case Block():
            return (), node.statements
        case If():
            bodies = tuple(body for _, body in node.branches)
            rest = () if node.otherwise is None else (node.otherwise,)
            return tuple(condition for condition, _ in node.branches), bodies + rest
        case While():
            return (node.condition,), (node.body,)
        case For():
            heads = (node.init, node.condition, node.step)
            return tuple(e for e in heads if e is not None), (node.body,)
        case ForEach():
            return (node.head,), (node.body,)
        case Switch():
            values = tuple(case.value for case in node.cases if case.value is not None)
            return (node.subject, *values), tuple(s for case in node.cases for s in case.body)
        case Export():
            return (node.assignment,), ()
        case Return(value=value) if value is not None:
            return (value,), ()
    return (), ()


def walk_context(statements: tuple[Statement, ...]) -> list[Expr]:
    """Every expression of one context, in source order, without entering function values."""
    found: list[Expr] = []
    todo: list[Statement | Expr] = list(reversed(statements))
    while todo:
        node = todo.pop()
        if isinstance(node, ExprStatement):
            todo.append(node.value)
        elif type(node) in _LEAVES:
            found.append(node)  # type: ignore[arg-type]
        elif type(node) in _STATEMENTS:
            expressions, inner = parts_of(node)  # type: ignore[arg-type]
            ordered = sorted((*expressions, *inner), key=lambda n: n.span)
            todo.extend(reversed(ordered))
        else:
            found.append(node)  # type: ignore[arg-type]
            todo.extend(reversed(child_expressions(node)))  # type: ignore[arg-type]
    return found

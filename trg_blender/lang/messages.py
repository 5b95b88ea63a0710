"""All texts of diagnostics, by code: English first, Russian second.

E1 scanner, E2 parser, E3 names, E4 running, E5 built-ins and files, E6 limits, E9 our own faults;
W7 warnings, L8 lints. Codes are stable; texts are not, and tests do not compare them.
"""

from __future__ import annotations

from collections.abc import Mapping

MESSAGES: dict[str, tuple[str, str]] = {
    "E100": ("unexpected character {text!r}", "неожиданный символ {text!r}"),
    "E101": ("a letter cannot follow a number", "буква не может стоять сразу после числа"),
    "E102": ("the number is too large", "число слишком велико"),
    "E103": ("a number has at most {limit} characters", "в числе не больше {limit} знаков"),
    "E104": ("the string is not closed", "строка не закрыта"),
    "E105": ("unknown escape '{text}' in a string", "неизвестная управляющая пара '{text}' в строке"),
    "E106": ("the comment is not closed", "комментарий не закрыт"),
    "E107": ("'{name}' is a reserved word", "'{name}' - зарезервированное слово"),
    "E108": ("a string has at most {limit} characters", "в строке не больше {limit} символов"),
    "E109": (
        "the program is longer than {limit} characters",
        "программа длиннее {limit} символов",
    ),
    "E110": (
        "a letter has at most {limit} combining marks",
        "у буквы не больше {limit} надстрочных и подстрочных знаков",
    ),
    "E201": ("expected '{text}'", "здесь нужен '{text}'"),
    "E202": ("')' has no matching '('", "у ')' нет парной '('"),
    "E203": ("expected a name", "здесь нужно имя"),
    "E204": ("'{text}' is a keyword, not a name", "'{text}' - служебное слово, а не имя"),
    "E205": ("expected an expression", "здесь нужно выражение"),
    "E206": ("only a variable or a field can be assigned to", "присвоить можно только переменной или полю"),
    "E207": (
        "'{text}' is not an operator that can be defined",
        "'{text}' - не операция, которую можно определить",
    ),
    "E208": ("two parameters are called '{name}'", "два параметра с именем '{name}'"),
    "E209": ("expected the name of a type in quotes", "здесь нужно имя типа в кавычках"),
    "E210": ("'}}' has no matching '{{'", "у '}}' нет парной '{{'"),
    "E211": ("the block is not closed", "блок не закрыт"),
    "E212": ("a switch has only one 'default'", "в switch только один 'default'"),
    "E213": ("expected 'case', 'default' or '}}'", "здесь нужно 'case', 'default' или '}}'"),
    "E214": (
        "'include' stands at the top level of a program only",
        "'include' пишется только на верхнем уровне программы",
    ),
    "E215": ("'include' takes a string in quotes", "'include' берёт строку в кавычках"),
    "E216": ("'break' outside of a loop or switch", "'break' вне цикла или switch"),
    "E217": ("'continue' outside of a loop", "'continue' вне цикла"),
    "E218": ("'return' outside of a function", "'return' вне функции"),
    "E220": (
        "the program is nested too deeply here (limit {limit})",
        "слишком глубокая вложенность (предел {limit})",
    ),
    "E221": (
        "the expression is too long (limit {limit} operators)",
        "выражение слишком длинное (предел {limit} операций)",
    ),
    "E222": (
        "the chain is too long (limit {limit} links)",
        "цепочка слишком длинная (предел {limit} звеньев)",
    ),
    "E223": ("too many arguments (limit {limit})", "слишком много аргументов (предел {limit})"),
    "E224": (
        "too many 'else if' in one chain (limit {limit})",
        "слишком много 'else if' подряд (предел {limit})",
    ),
    "E225": ("loops are nested too deeply (limit {limit})", "циклы вложены слишком глубоко (предел {limit})"),
    "E226": (
        "too many cases in one switch (limit {limit})",
        "слишком много case в одном switch (предел {limit})",
    ),
    "E227": (
        "too many elements in one list (limit {limit})",
        "слишком много элементов в одном списке (предел {limit})",
    ),
    "E230": (
        "'export' stands at the top level of a program only",
        "'export' пишется только на верхнем уровне программы",
    ),
    "E231": (
        'expected range(low, high) or choice("a", "b")',
        'здесь нужно range(от, до) или choice("a", "b")',
    ),
    "E301": ("'{name}' is not a variable of this function", "'{name}' - не переменная этой функции"),
    "E302": ("'{name}' is not defined", "имя '{name}' не определено"),
    "E303": ("'{name}' is not defined in this function", "имя '{name}' не определено в этой функции"),
    "E304": ("there is no type '{name}'", "нет типа '{name}'"),
    "E310": ("'{name}' is built in and cannot be replaced", "имя '{name}' встроено, заменить его нельзя"),
    "E311": ("names in '{name}::' are built in", "имена в '{name}::' встроенные"),
    "E320": ("'{name}' includes itself", "файл '{name}' включает сам себя"),
    "E321": ("too many included files (limit {limit})", "слишком много включённых файлов (предел {limit})"),
    "E322": (
        "includes are nested too deeply (limit {limit})",
        "слишком глубокие включения файлов (предел {limit})",
    ),
    "E330": (
        "the default of a parameter is a number, a string, or vec3 of numbers, as written",
        "значение параметра по умолчанию - число, строка или vec3 из чисел, записанные прямо",
    ),
    "E331": ("'{name}' is exported twice", "'{name}' экспортируется дважды"),
    "E332": (
        "the default of '{name}' must be {wanted}, not {value}",
        "значение '{name}' по умолчанию должно быть {wanted}, а не {value}",
    ),
    "E333": ("a parameter cannot be of type '{name}'", "у параметра не может быть типа '{name}'"),
    "E334": (
        "{name} fits parameters of type {wanted} and takes {usage}",
        "{name} подходит параметрам типа {wanted} и пишется {usage}",
    ),
    "E401": ("division by zero", "деление на ноль"),
    "E410": ("cannot compute {left} {op} {right}", "нельзя вычислить {left} {op} {right}"),
    "E411": (
        "a variable without a value cannot be joined to a string",
        "переменную без значения нельзя присоединить к строке",
    ),
    "E412": ("cannot compare {left} {op} {right}", "нельзя сравнить {left} {op} {right}"),
    "E413": ("cannot compute {op} of {kind}", "нельзя применить {op} к {kind}"),
    "E415": ("Render() cannot be called inside an operator", "Render() нельзя вызвать внутри операции"),
    "E416": ("the operator field does not hold a function", "поле операции - не функция"),
    "E420": ("{article} {kind} has no fields ('{name}')", "у значения {kind} нет полей ('{name}')"),
    "E421": ("{kind} has no field '{name}'", "у {kind} нет поля '{name}'"),
    "E422": (
        "'{name}' has no value yet, so it has no fields",
        "у '{name}' ещё нет значения, поэтому нет и полей",
    ),
    "E423": ("the field '{name}' of a vec3 cannot be changed", "поле '{name}' у vec3 изменить нельзя"),
    "E424": ("the field '{name}' of {kind} cannot be set", "полю '{name}' у {kind} присвоить нельзя"),
    "E430": ("{article} {kind} cannot be called", "{kind} нельзя вызвать"),
    "E431": (
        "'{name}' has no value yet, so it cannot be called",
        "у '{name}' ещё нет значения, вызвать нельзя",
    ),
    "E432": ("'{name}' needs the argument '{parameter}'", "'{name}' нужен аргумент '{parameter}'"),
    "E433": (
        "'{name}' takes {wanted} arguments, {given} given",
        "'{name}' берёт аргументов: {wanted}, дано {given}",
    ),
    "E434": (
        "parameter '{name}' must be {wanted}, not {kind}",
        "параметр '{name}' должен быть {wanted}, а не {kind}",
    ),
    "E440": ("{kind} has no elements", "у {kind} нет элементов"),
    "E441": (
        "an index must be a whole number of at least 0, not {value}",
        "индекс должен быть целым числом не меньше 0, а не {value}",
    ),
    "E442": (
        "index {index} is outside of the list: it has {count} elements",
        "индекс {index} вне списка: в нём элементов - {count}",
    ),
    "E443": ("an index must be a number, not {kind}", "индекс должен быть числом, а не {kind}"),
    "E444": ("'for ... in' goes over a list, not {kind}", "'for ... in' перебирает список, а не {kind}"),
    "E445": ("the list is empty", "список пуст"),
    "E446": (
        "'{name}' has no value yet, so it has no elements",
        "у '{name}' ещё нет значения, поэтому нет и элементов",
    ),
    "E501": (
        "{name} expects {wanted} as argument {index} ('{parameter}'), not {kind}",
        "{name}: аргумент {index} ('{parameter}') должен быть {wanted}, а не {kind}",
    ),
    "E502": (
        "{name} needs numbers: argument {index} ('{parameter}') is {kind}",
        "{name} нужны числа: аргумент {index} ('{parameter}') - {kind}",
    ),
    "E503": ("{name}: argument {index} is not finite", "{name}: аргумент {index} не конечен"),
    "E504": (
        "{name}: argument {index} ('{parameter}') must be {wanted}, not {value}",
        "{name}: аргумент {index} ('{parameter}') должен быть {wanted}, а не {value}",
    ),
    "E505": (
        "{name}: argument {index} is a colour and cannot be negative",
        "{name}: аргумент {index} - цвет и не может быть отрицательным",
    ),
    "E506": (
        "{name} takes {wanted} arguments, {given} given",
        "{name} берёт аргументов: {wanted}, дано {given}",
    ),
    "E507": (
        "{name}: argument {index} ('{parameter}') has no value yet",
        "{name}: у аргумента {index} ('{parameter}') ещё нет значения",
    ),
    "E508": ("{name}: {reason}", "{name}: {reason}"),
    "E510": ("'{name}' must stay inside the project", "'{name}' должен лежать внутри проекта"),
    "E511": ("cannot find '{name}'", "не найден файл '{name}'"),
    "E512": ("'{name}' cannot be read as text", "'{name}' нельзя прочитать как текст"),
    "E520": ("the program exports no parameter '{name}'", "программа не экспортирует параметр '{name}'"),
    "E521": (
        "the value of '{name}' must be {wanted}, not {value}",
        "значение '{name}' должно быть {wanted}, а не {value}",
    ),
    "E601": (
        "the instruction budget of {limit} steps for a frame is used up",
        "исчерпан предел шагов на кадр (instruction budget): {limit}",
    ),
    "E602": (
        "the time limit of {limit:g} seconds for a frame is used up",
        "исчерпано время на кадр: {limit:g} с",
    ),
    "E604": (
        "the program uses too much memory (limit {limit} MB)",
        "программе нужно слишком много памяти (предел {limit} МБ)",
    ),
    "E605": ("the string is longer than {limit} characters", "строка длиннее {limit} символов"),
    "E606": (
        "the strings of the program use more than {limit} MB",
        "строки программы занимают больше {limit} МБ",
    ),
    "E607": (
        "calls of '{name}' are nested too deeply (limit {limit})",
        "вызовы '{name}' вложены слишком глубоко (предел {limit})",
    ),
    "E608": (
        "operators are nested too deeply (limit {limit})",
        "операции вложены слишком глубоко (предел {limit})",
    ),
    "E609": ("cancelled", "отменено"),
    "E610": (
        "too many shapes and lights (limit {limit})",
        "слишком много тел и источников света (предел {limit})",
    ),
    "E611": (
        "the computer has no memory left for the program",
        "у компьютера не осталось памяти для программы",
    ),
    "E612": (
        "the lists of the program hold more than {limit} elements",
        "в списках программы больше {limit} элементов",
    ),
    "E613": (
        "the program holds too many values and objects (limit {limit} blocks of memory)",
        "программа держит слишком много значений и объектов (предел {limit} блоков памяти)",
    ),
    "E900": (
        "internal error in TRG: {kind}; please report it",
        "внутренняя ошибка TRG: {kind}; сообщите о ней",
    ),
    "W701": ("this variable has no value yet; 0 is used", "у переменной ещё нет значения; взят 0"),
    "W702": ("cannot find '{name}'; a placeholder is used", "не найден файл '{name}'; взята замена"),
    "W703": (
        "unknown {what} '{name}'; the host's own is used",
        "неизвестно: {what} '{name}'; взято то, что задано в программе-хозяине",
    ),
    "W704": (
        "'{name}' was entered before what it calls could render; enter it again",
        "'{name}' введена раньше, чем то, что она вызывает, стало рисовать; введите её ещё раз",
    ),
    "L801": (
        "this assigns; a condition usually compares",
        "здесь присваивание, а в условии обычно сравнение",
    ),
    "L802": ("'{name}' hides the built-in of that name", "'{name}' закрывает встроенное имя"),
    "L803": ("this case runs on into the next one", "этот case переходит в следующий"),
    "L804": (
        "'{name}' looks like another name but has letters of another alphabet",
        "'{name}' выглядит как другое имя, но в нём буквы другого алфавита",
    ),
}

HINTS: dict[str, tuple[str, str]] = {
    "append": ("append(value) adds an element", "append(значение) добавляет элемент"),
    "from_the_end": (
        "count from the end with l[len(l) - 1]",
        "с конца считают так: l[len(l) - 1]",
    ),
    "round_index": ("write mth::floor(i)", "пишите mth::floor(i)"),
    "assignable": ("write name = ... or object.field = ...", "пишите имя = ... или объект.поле = ..."),
    "choose_other_name": ("choose another name", "выберите другое имя"),
    "choose_other_space": (
        "choose a space of your own, for example my::",
        "выберите своё пространство имён, например my::",
    ),
    "close_string": ('write " before the end of the line', 'поставьте " до конца строки'),
    "closes_too_early": (
        "perhaps the ')' at {place} closes too early",
        "возможно, ')' в {place} закрывает слишком рано",
    ),
    "did_you_mean": ("did you mean '{name}'?", "может быть, '{name}'?"),
    "did_you_mean_field": ("did you mean '{guess}'?", "может быть, '{guess}'?"),
    "double_backslash": ("write \\\\ or use /", "пишите \\\\ или /"),
    "double_quotes": ("strings stand in double quotes", "строки пишутся в двойных кавычках"),
    "fixed_limit": ("this limit is fixed", "этот предел постоянен"),
    "global_here": ("the global is assigned here", "глобальной переменной присвоено здесь"),
    "outer_variable": ("a variable of the function around it", "переменная внешней функции"),
    "exported_here": ("exported here", "экспортируется здесь"),
    "argument_here": ("the argument", "аргумент"),
    "no_conditional": (
        "there is no '?:'; write if (...) ... else ...",
        "операции '?:' нет; пишите if (...) ... else ...",
    ),
    "new_list": ("make a list first: {name} = [];", "сначала создайте список: {name} = [];"),
    "new_vector": ("make a new one: vec3(x, y, z)", "создайте новый: vec3(x, y, z)"),
    "not_a_closure": (
        "functions do not see the variables of the function around them; pass it as an argument",
        "функция не видит переменных внешней функции; передайте значение аргументом",
    ),
    "overloads": (
        "one of + - * / % == != < > <= >= ! follows 'operator'",
        "после 'operator' одна из + - * / % == != < > <= >= !",
    ),
    "raise_limit": (
        "call Scene.Render() in the loop, or raise the limit (--limit {option}=N, or the preferences)",
        "вызовите Scene.Render() в цикле или увеличьте предел (--limit {option}=N или настройки)",
    ),
    "raise_other": (
        "raise the limit with --limit {option}=N, or in the preferences",
        "увеличьте предел: --limit {option}=N или в настройках",
    ),
    "repeat": ("repeat it with: {command}", "повторить: {command}"),
    "reserved": ("reserved for later versions", "оставлено для следующих версий"),
    "reserved_word": ("this keyword cannot stand here", "это служебное слово здесь не может стоять"),
    "split_expression": ("split it into several statements", "разбейте на несколько операторов"),
    "split_loops": ("move the inner loops into a function", "вынесите внутренние циклы в функцию"),
    "split_nesting": ("move a part into a function", "вынесите часть в функцию"),
    "split_number": ("put a space or an operator in between", "поставьте между ними пробел или операцию"),
    "type_string": ('for example ~ "num"', 'например ~ "num"'),
    "usage": ("{usage}", "{usage}"),
    "write_0": ("write 0", "пишите 0"),
    "write_1": ("write 1", "пишите 1"),
    "other_name": ("the other name", "другое имя"),
    "write_again": (
        "type it anew as '{other}' in one alphabet, or choose another name",
        "наберите '{other}' заново в одной раскладке или выберите другое имя",
    ),
    "write_and": ("write &&", "пишите &&"),
    "write_break": ("end it with break; if that is not meant", "завершите его break;, если это не нарочно"),
    "write_equals": ("write == to compare", "для сравнения пишите =="),
    "write_hash": ("write #{name} for the global variable", "для глобальной переменной пишите #{name}"),
    "write_or": ("write ||", "пишите ||"),
    "write_pow": ("write mth::pow(x, y)", "пишите mth::pow(x, y)"),
    "write_vec3": (
        "write vec3(1) for a vector of equal components",
        "пишите vec3(1) - вектор из равных чисел",
    ),
}

LANGUAGES = ("en", "ru")


def message_text(code: str, language: str, values: Mapping[str, object]) -> str:
    """The message of a code, filled in. KeyError for a code that the table lacks."""
    return MESSAGES[code][LANGUAGES.index(language)].format(**values)


def hint_text(key: str, language: str, values: Mapping[str, object]) -> str:
    """The hint of a key, filled in. KeyError for a key that the table lacks."""
    return HINTS[key][LANGUAGES.index(language)].format(**values)

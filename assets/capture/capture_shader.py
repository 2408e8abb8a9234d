"""Text of a shader as its preprocessor leaves it."""
import re

TOKENS = re.compile(r"\s*(\|\||&&|==|!=|<=|>=|[()!<>+*-]|\d+|[A-Za-z_]\w*)")
LEVELS = (("||",), ("&&",), ("==", "!="), ("<", ">", "<=", ">="), ("+", "-"), ("*",))
MEANINGS = {"||": lambda a, b: int(bool(a or b)), "&&": lambda a, b: int(bool(a and b)),
            "==": lambda a, b: int(a == b), "!=": lambda a, b: int(a != b), "<": lambda a, b: int(a < b),
            ">": lambda a, b: int(a > b), "<=": lambda a, b: int(a <= b), ">=": lambda a, b: int(a >= b),
            "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b}
MAX_EXPRESSION = 1000


class Expression:
    """Value of the expression of an #if. ValueError where it has what is not understood."""

    def __init__(self, text, defines):
        self.defines, self.tokens, at = defines, [], 0
        text = text.strip()
        if len(text) > MAX_EXPRESSION:
            raise ValueError("too long")
        while at < len(text):
            found = TOKENS.match(text, at)
            if not found:
                raise ValueError("not understood")
            self.tokens.append(found[1])
            at = found.end()
        self.tokens.append("")

    def value(self):
        result = self.level(0)
        if self.tokens[0]:
            raise ValueError("not understood")
        return result

    def level(self, number):
        if number == len(LEVELS):
            return self.unary()
        left = self.level(number + 1)
        while self.tokens[0] in LEVELS[number]:
            left = MEANINGS[self.tokens.pop(0)](left, self.level(number + 1))
        return left

    def unary(self):
        token = self.tokens.pop(0)
        if token == "!":
            return int(not self.unary())
        if token == "-":
            return -self.unary()
        if token == "(":
            result = self.level(0)
            if self.tokens.pop(0) != ")":
                raise ValueError("not understood")
            return result
        if token == "defined":
            bracket = self.tokens[0] == "("
            name = self.tokens[1 if bracket else 0]
            del self.tokens[:3 if bracket else 1]
            return int(name in self.defines)
        if token.isdigit():
            return int(token)
        if not token or not (token[0].isalpha() or token[0] == "_"):
            raise ValueError("not understood")
        return int(self.defines.get(token) or 0)


def is_true(text, defines):
    """Returns whether an #if holds. One that is not understood counts as true, so that no code is missed."""
    try:
        return bool(Expression(text, defines).value())
    except (ValueError, IndexError, RecursionError):
        return True


def live_text(text):
    """Returns GLSL without comments and without branches that its preprocessor leaves out."""
    text = re.sub(r"/\*.*?(?:\*/|\Z)|//[^\n]*", " ", text.replace("\\\n", " "), flags=re.S)
    defines, branches, out = {}, [], []  # branches: (is live, a branch of it was live)
    for line in text.split("\n"):
        directive = re.match(r"\s*#\s*(\w+)\s*(.*)", line)
        live = all(b[0] for b in branches)
        if not directive:
            if live:
                out.append(line)
            continue
        word, rest = directive[1], directive[2].strip()
        if word in ("if", "ifdef", "ifndef"):
            if word == "if":
                holds = live and is_true(rest, defines)
            else:
                holds = live and (rest.split(" ")[0] in defines) == (word == "ifdef")
            branches.append((holds, holds))
        elif word in ("elif", "else") and branches:
            _, taken = branches.pop()
            outer = all(b[0] for b in branches)
            holds = outer and not taken and (word == "else" or is_true(rest, defines))
            branches.append((holds, taken or holds))
        elif word == "endif" and branches:
            branches.pop()
        elif word == "define" and live:
            name = re.match(r"(\w+)(\([^)]*\))?\s*(.*)", rest)
            if name:
                value = name[3].strip()
                defines[name[1]] = value if value.isdigit() and not name[2] else defines.get(value, "1")
        elif word == "undef" and live:
            defines.pop(rest, None)
    return "\n".join(out)

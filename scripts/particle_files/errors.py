"""What the programs say when they cannot go on, and the code they end with."""


class UsageError(Exception):
    """An option has a value that makes no sense."""

    exit_code = 1


class InputError(Exception):
    """A file cannot be read, or does not hold what it should."""

    exit_code = 2


class OutputError(Exception):
    """A file cannot be written."""

    exit_code = 4

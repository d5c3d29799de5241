"""The known problems: each is told in one line that says what, where and what to do."""


class DiffbotError(Exception):
    """Root of every problem that a user can mend; commands print it and exit with 1."""


class ConfigError(DiffbotError):
    """A parameter file or a parameter value that cannot be used."""


class BagError(DiffbotError):
    """A bag that is missing, unreadable or lacks a topic."""


class DataError(DiffbotError):
    """Recorded data from which nothing can be concluded."""

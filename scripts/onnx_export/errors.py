"""The one error of the exporter."""


class ExportError(Exception):
    """A sentence that says what is wrong, where, and what to do."""

"""What goes wrong for a reason that its user can mend."""


class MudlineError(Exception):
    """One line that says what is wrong: in a file, in what was asked for, or in what the program said about a deck."""

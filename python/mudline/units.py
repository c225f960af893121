"""Units in which numbers are easy to read: kPa, kN, mm, days."""

PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""))
TIMES = ((31557600.0, "years"), (86400.0, "days"), (3600.0, "hours"), (60.0, "min"))  # [s]


def scaled(unit, largest):
    """(factor, unit) for numbers in an SI unit, the largest of them given: 52000 Pa becomes 52 kPa."""
    if unit in ("m", "s"):
        prefixes = ((1.0, ""), (1e-3, "m"))
    elif unit in ("Pa", "N", "J", "W", "N/m", "N m"):
        prefixes = PREFIXES
    else:
        return 1.0, unit
    for size, prefix in prefixes:
        if largest >= size:
            return 1 / size, prefix + unit
    return 1.0, unit


def time_unit(span):
    """(factor, unit) for times over a span [s]: long ones read better in minutes, hours, days or years."""
    for size, name in TIMES:
        if span >= 2 * size:
            return 1 / size, name
    return 1.0, "s"

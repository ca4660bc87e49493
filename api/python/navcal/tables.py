# SPDX-License-Identifier: Apache-2.0
"""Samples as tables of pandas and xarray, and back.

    import navcal

    frames = navcal.frames(navcal.Recording("dive.cap").arrays())
    frames["compass"]["heading_rad"].plot()

pandas or xarray is imported when a function needs it (Debian packages python3-pandas, python3-xarray).
"""
import numpy

_TIME = "time_ns"


def _axis_of(name):
    """Dimension of a column of three numbers, and the names of its components."""
    return ("fin", ["1", "2", "3"]) if name.startswith("fins_") else ("axis", ["x", "y", "z"])


def _measured(table):
    """Name, values and whether they are vectors, of each column but the time."""
    for name, values in table.items():
        if name != _TIME:
            yield name, values, getattr(values, "ndim", 1) == 2


def frames(arrays):
    """DataFrames of the kinds of samples in `arrays` (Recording.arrays()).

    The index is the time of measurement, UTC. A vector becomes a column for each component: rate_rad_s_x,
    rate_rad_s_y and rate_rad_s_z; a column of fins becomes fins_rad_1 to fins_rad_3. Numbers are not copied.
    """
    import pandas

    made = {}
    for kind, table in arrays.items():
        series = {}
        for name, values, are_vectors in _measured(table):
            if are_vectors:
                for at, component in enumerate(_axis_of(name)[1]):
                    series[f"{name}_{component}"] = values[:, at]
            else:
                series[name] = values
        index = pandas.DatetimeIndex(table[_TIME].view("datetime64[ns]"), name="time").tz_localize("UTC")
        made[kind] = pandas.DataFrame(series, index=index, copy=False)
    return made


def datasets(arrays):
    """xarray Datasets of the kinds of samples in `arrays` (Recording.arrays()).

    Dimensions are time (of measurement, UTC), and axis (x, y, z) or fin (1, 2, 3) of vectors. Numbers are not copied.
    """
    import xarray

    made = {}
    for kind, table in arrays.items():
        variables, coordinates = {}, {"time": table[_TIME].view("datetime64[ns]")}
        for name, values, are_vectors in _measured(table):
            if are_vectors:
                axis, components = _axis_of(name)
                coordinates[axis] = components
                variables[name] = (("time", axis), values)
            else:
                variables[name] = (("time",), values)
        made[kind] = xarray.Dataset(variables, coordinates)
    return made


def columns(table):
    """The columns of a DataFrame or Dataset that frames() or datasets() made, as in Recording.arrays()."""
    if hasattr(table, "data_vars"):
        found = {_TIME: table["time"].values.astype("datetime64[ns]").view(numpy.int64)}
        found.update({name: _plain(variable.values) for name, variable in table.data_vars.items()})
        return found
    found = {_TIME: table.index.tz_convert(None).values.astype("datetime64[ns]").view(numpy.int64)}
    names = list(table.columns)
    while names:
        name = names.pop(0)
        stem, _, component = name.rpartition("_")
        components = _axis_of(stem)[1]
        group = [f"{stem}_{each}" for each in components]
        if stem and component == components[0] and set(group[1:]) <= set(names):
            found[stem] = numpy.column_stack([table[each].to_numpy() for each in group])
            names = [each for each in names if each not in group]
        else:
            found[name] = _plain(table[name].to_numpy())
    return found


def _plain(values):
    """Numbers as an array, texts as a list."""
    return values.tolist() if values.dtype.kind in "OUS" else values

# SPDX-License-Identifier: Apache-2.0
"""Finds parameters of a case from measured curves: `piola identify fit.toml`, or `python3 -m piola_identify`.

problem reads the file, curves the measurements, runs starts the program, fit finds the parameters, report writes them.
No module needs the compiled module of Piola.
"""

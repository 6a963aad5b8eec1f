# SPDX-License-Identifier: Apache-2.0
"""Turns meshes and cards of other programs into cases of Piola: `piola import`, or `python3 -m piola_import`.

The readers (lsdyna, abaqus, meshes, points) fill a Model in SI units; write_case writes it as case.toml with surfaces
or particles. No module needs the compiled module of Piola.
"""

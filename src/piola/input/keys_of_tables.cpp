// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include "piola/input/table_keys.hpp"
#include <array>

namespace piola {
namespace {

using enum KeyInfo::Kind;
using Options = TableFunction::Options;

constexpr std::array<std::string_view, 2> interpolation_words{"linear", "smooth"};
constexpr std::array<std::string_view, 3> outside_words{"hold", "zero", "error"};

constexpr std::array table_rows{
    BoundKey<TableSpec>{{"table", "table", list, "", any_value, "by file",
                         "rows [x, value], two or more, x increasing; with units as texts: [\"1 ms\", \"5 kN\"]"}},
    BoundKey<TableSpec>{{"table", "file", text, "", any_value, "by table",
                         "path from the case file of a CSV file: x in the first column, the values in the second, "
                         "with a header such as \"time [ms],force [kN]\"; without units or header: SI units"},
                        fills<&TableSpec::file>},
    BoundKey<TableSpec>{{"table", "column", text, "", any_value, "the second",
                         "file: title of the column of the values, without its unit; needed if there are several"},
                        fills<&TableSpec::column>},
    BoundKey<TableSpec>{{"table", "over", formula, "", any_value, "t",
                         "what x is: a formula in X, Y, Z, t, such as \"X\" for a profile along the x axis"}},
    BoundKey<TableSpec>{{"table", "interpolation", word, "", any_value, default_of_member,
                         "between rows; smooth: cubics without overshoot (PCHIP)", interpolation_words},
                        fills<&TableSpec::options, &Options::interpolation>},
    BoundKey<TableSpec>{{"table", "before", word, "", any_value, default_of_member,
                         "value before the first row; hold: that of the row, error: the run stops", outside_words},
                        fills<&TableSpec::options, &Options::before>},
    BoundKey<TableSpec>{
        {"table", "after", word, "", any_value, default_of_member, "value after the last row", outside_words},
        fills<&TableSpec::options, &Options::after>},
    BoundKey<TableSpec>{{"table", "scale", quantity, "1", any_value, default_of_member, "factor of all values"},
                        fills<&TableSpec::scale>},
    BoundKey<TableSpec>{{"table", "derivative", flag, "", any_value, default_of_member,
                         "velocities: the rows are displacements, or angles; the velocity is the slope between them"},
                        fills<&TableSpec::derivative>},
};

}  // namespace

std::span<BoundKey<TableSpec> const> table_keys() { return table_rows; }

std::vector<KeyInfo> keys_of_tables() { return joined_keys(table_keys()); }

}  // namespace piola

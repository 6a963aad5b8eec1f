// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/cloud_table.hpp"
#include <string>
#include <vector>

namespace piola {

/// Points from an HDF5 file of another program: the lists of numbers in a group (empty: the file itself) are called as
/// the columns of a table are, or a table of places holds all components (output/foreign_hdf5.hpp). `length_unit` [m]
/// counts where no list has an attribute `unit` or `units`. What is wrong is added to `problems`.
CloudTable read_cloud_datasets(std::string const& path, std::string const& group, double length_unit,
                               std::vector<std::string>& problems);

}  // namespace piola

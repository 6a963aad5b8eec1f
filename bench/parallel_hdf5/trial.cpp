// SPDX-License-Identifier: Apache-2.0
// What collective writing by parallel HDF5 takes, and what it says when a rank cannot write: a table of N rows of 9
// numbers, of which ranks have leaves of 16 rows in turn, as contiguous data or deflated chunks. For record 26.
//
// mpicxx -O2 -std=c++20 -I/usr/include/hdf5/openmpi bench/parallel_hdf5/trial.cpp -lhdf5_openmpi -o trial
// mpirun -n 2 trial FILE [N [leaves|stretches [deflate]]]       (default: 1000000 leaves)
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <hdf5.h>
#include <mpi.h>
#include <vector>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of the file size is an error, not a signal
  if (argc < 2) MPI_Abort(MPI_COMM_WORLD, 2);
  hsize_t const wanted = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1'000'000, leaf = 16, columns = 9;
  bool const stretches = argc > 3 && std::strcmp(argv[3], "stretches") == 0, deflate = argc > 4;
  hsize_t const turns = wanted / (leaf * ranks), rows = turns * leaf * ranks, own = turns * leaf;
  std::vector<double> values(own * columns);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1.0 / static_cast<double>(k + values.size() * rank + 1);

  MPI_Barrier(MPI_COMM_WORLD);
  auto const start = std::chrono::steady_clock::now();
  hid_t const access = H5Pcreate(H5P_FILE_ACCESS), way = H5Pcreate(H5P_DATASET_XFER),
              layout = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL);
  H5Pset_dxpl_mpio(way, H5FD_MPIO_COLLECTIVE);
  H5Pset_obj_track_times(layout, false);
  if (deflate) {
    hsize_t const chunk[2] = {(1U << 20) / (columns * sizeof(double)), columns};
    H5Pset_chunk(layout, 2, chunk);
    H5Pset_shuffle(layout);
    H5Pset_deflate(layout, 1);
  }
  hid_t const file = H5Fcreate(argv[1], H5F_ACC_TRUNC, H5P_DEFAULT, access);
  hsize_t const shape[2] = {rows, columns}, mine[2] = {own, columns};
  hid_t const space = H5Screate_simple(2, shape, nullptr), memory = H5Screate_simple(2, mine, nullptr);
  hid_t const set = H5Dcreate2(file, "t", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, layout, H5P_DEFAULT);
  hsize_t const first[2] = {stretches ? own * rank : leaf * rank, 0},
                stride[2] = {stretches ? own : leaf * ranks, columns}, count[2] = {stretches ? 1 : turns, 1},
                block[2] = {stretches ? own : leaf, columns};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, first, stride, count, block);
  herr_t const written = H5Dwrite(set, H5T_NATIVE_DOUBLE, memory, space, way, values.data());
  herr_t const set_closed = H5Dclose(set), file_closed = H5Fclose(file);
  double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("rank %d: %.0f MB of all in %.3f s; write %d, close of set %d, of file %d\n", rank,
              static_cast<double>(rows * columns * sizeof(double)) / 1e6, seconds, written, set_closed, file_closed);
  H5Sclose(space);
  H5Sclose(memory);
  H5Pclose(access);
  H5Pclose(way);
  H5Pclose(layout);
  MPI_Finalize();
}

# SPDX-License-Identifier: Apache-2.0
# cuda_compile: the passes must stay acceptable to nvcc. Compiles, does not run; tools/check_cuda holds the flags.

add_custom_target(cuda_compile
  COMMAND "${PROJECT_SOURCE_DIR}/tools/check_cuda" --out "${PROJECT_BINARY_DIR}/cuda"
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" USES_TERMINAL VERBATIM)

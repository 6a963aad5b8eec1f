# SPDX-License-Identifier: Apache-2.0
# piola_native_backend(OUT): the best backend that this processor can run, as the compiler sees the processor: v4, v3
# or scalar. It looks at the features that processor_can_run() in src/piola/exec/backend_registry.cpp looks at when
# the program starts.

function(piola_native_backend out)
  set(backend scalar)
  execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -march=native -dM -E -x c++ /dev/null
                  OUTPUT_VARIABLE macros ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0)
    set(features_v3 AVX2 FMA BMI2)
    set(features_v4 ${features_v3} AVX512F AVX512DQ AVX512BW AVX512VL AVX512CD)
    foreach(candidate IN ITEMS v3 v4)
      set(complete TRUE)
      foreach(feature IN LISTS features_${candidate})
        if(NOT macros MATCHES "#define __${feature}__ 1")
          set(complete FALSE)
        endif()
      endforeach()
      if(complete)
        set(backend ${candidate})
      endif()
    endforeach()
  endif()
  set(${out} ${backend} PARENT_SCOPE)
endfunction()

# Who may include whom, and where external libraries and allocations may stand. Run: cmake -D ROOT=<root> -P includes.cmake
cmake_policy(SET CMP0057 NEW)

# folder: the folders it may include
set(ALLOW_core core)
set(ALLOW_eos ${ALLOW_core} eos)
set(ALLOW_constitutive ${ALLOW_eos} constitutive)
set(ALLOW_mpm ${ALLOW_constitutive} mpm)
set(ALLOW_coupling ${ALLOW_mpm} coupling)
set(ALLOW_twopoint ${ALLOW_coupling} twopoint)
set(ALLOW_ice ${ALLOW_coupling} ice)
set(ALLOW_references core references)
set(ALLOW_run ${ALLOW_coupling} twopoint ice references run)
set(FOLDERS core eos constitutive mpm coupling twopoint ice references run)

# what stands in one file only: a pattern and that file
set(ONLY
  "include <(HYPRE|mpi)" core/linear_hypre.c
  "include <(cholmod|umfpack)" core/linear_direct.c
  "include <omp" core/parallel.c
  "include <hdf5" run/h5.c
  "include <cjson" run/json.h
  "[^a-z_](malloc|calloc|realloc|aligned_alloc|strdup) *\\(" core/memory.c)

set(FAULTS 0)
macro(fault text)
  math(EXPR FAULTS "${FAULTS} + 1")
  message(SEND_ERROR "${text}")
endmacro()

function(check_includes folder file text)
  string(REGEX MATCHALL "#include \"[^\"]*\"" includes "${text}")
  foreach(include ${includes})
    string(REGEX REPLACE "#include \"(.*)\"" "\\1" path "${include}")
    string(REGEX MATCH "^[a-z]+" target "${path}")
    if(path MATCHES "/" AND NOT target IN_LIST ALLOW_${folder})
      fault("${file}: ${folder}/ may not include ${path}")
    endif()
  endforeach()
  set(FAULTS ${FAULTS} PARENT_SCOPE)
endfunction()

function(check_only file text)
  list(LENGTH ONLY n)
  foreach(i RANGE 0 ${n} 2)
    if(i LESS n)
      math(EXPR j "${i} + 1")
      list(GET ONLY ${i} pattern)
      list(GET ONLY ${j} home)
      if(NOT file STREQUAL home AND text MATCHES "${pattern}")
        fault("${file}: \"${CMAKE_MATCH_0}\" may stand in ${home} only")
      endif()
    endif()
  endforeach()
  set(FAULTS ${FAULTS} PARENT_SCOPE)
endfunction()

set(COUNT 0)
foreach(folder ${FOLDERS})
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${folder}/*.c ${ROOT}/${folder}/*.h)
  foreach(file ${files})
    file(READ ${ROOT}/${file} text)
    string(REPLACE ";" "," text "${text}")
    string(REPLACE "[" "(" text "${text}")
    string(REPLACE "]" ")" text "${text}")
    check_includes(${folder} ${file} "${text}")
    check_only(${file} "${text}")
    math(EXPR COUNT "${COUNT} + 1")
  endforeach()
endforeach()
if(COUNT LESS 20)
  fault("only ${COUNT} files found below ${ROOT}")
endif()
message(STATUS "${COUNT} files, ${FAULTS} faults")

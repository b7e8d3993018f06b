# One shipped case on one path: the quick variant must meet its limits, and its plan must be the one in review.
# cmake -D PROGRAM= -D CASE=<folder of the case> -D FLUID=<path or solid> -D OUT= [-D WRITE_PLAN=ON] -P case.cmake
cmake_path(GET CASE FILENAME name)
set(fluid "")
if(NOT FLUID STREQUAL solid)
  set(fluid --fluid ${FLUID})
endif()

file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${PROGRAM} run ${CASE}/scene.json ${fluid} --quick --force --out ${OUT} RESULT_VARIABLE result)
if(NOT result EQUAL 0 AND NOT WRITE_PLAN)
  message(FATAL_ERROR "${name} on ${FLUID}: exit status ${result}")
endif()

# plan.txt of a case: a line "path <name>" before each path's plan
file(READ ${OUT}/plan.txt now)
set(now "path ${FLUID}\n${now}")
set(review "")
if(EXISTS ${CASE}/plan.txt)
  file(READ ${CASE}/plan.txt review)
endif()
if(WRITE_PLAN)
  file(WRITE ${CASE}/plan.txt "${review}${now}")
  return()
endif()
string(FIND "${review}" "${now}" place)
if(place EQUAL -1)
  message(FATAL_ERROR "${name} on ${FLUID}: ${OUT}/plan.txt is not in ${CASE}/plan.txt; if the change is meant: ./dev plans")
endif()

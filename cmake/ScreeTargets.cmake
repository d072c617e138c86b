find_package(Threads REQUIRED)

# Headers that many sources parse: scree_precompiled(NAME HEADER libraries whose flags they need …) compiles them once,
# and target_precompile_headers(TARGET REUSE_FROM NAME) hands the result to a target of the same flags.
function(scree_precompiled NAME HEADER)
  add_library(${NAME} OBJECT EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${NAME} PRIVATE scree_usage ${ARGN})
  target_precompile_headers(${NAME} PRIVATE ${HEADER})
endfunction()

# One static library per folder, from every .cpp in it.
# Usage: scree_library(NAME [PRECOMPILED other precompiled headers than most have] [libraries to link …])
function(scree_library NAME)
  cmake_parse_arguments(PARSE_ARGV 1 WITH "" PRECOMPILED "")
  if(NOT WITH_PRECOMPILED)
    set(WITH_PRECOMPILED scree_precompiled)
  endif()
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(${NAME} STATIC ${SOURCES})
  target_link_libraries(${NAME} PUBLIC ${WITH_UNPARSED_ARGUMENTS})
  target_precompile_headers(${NAME} REUSE_FROM ${WITH_PRECOMPILED})
endfunction()

# Options and reports: nobody waits for them to run, but for CLI11 and nlohmann's JSON to compile, which are headers
# only. Usage: scree_optimise_little(SOURCES …)
function(scree_optimise_little)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
endfunction()

# A program that reads options.
function(scree_program NAME MAIN)
  add_executable(${NAME} ${MAIN})
  target_link_libraries(${NAME} PRIVATE ${ARGN} CLI11::CLI11 nlohmann_json::nlohmann_json)
  target_precompile_headers(${NAME} REUSE_FROM scree_precompiled_options)
  scree_optimise_little(${MAIN})
endfunction()

# Asio is headers only, and what they define depends on these: every target in one program must say the same.
# Without the last it would go by what happens to be included before: memory from malloc, given to delete.
function(scree_uses_asio NAME)
  target_compile_definitions(${NAME} PRIVATE ASIO_STANDALONE ASIO_NO_DEPRECATED ASIO_DISABLE_STD_ALIGNED_ALLOC)
  target_link_libraries(${NAME} PRIVATE Threads::Threads)
endfunction()

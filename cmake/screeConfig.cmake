# find_package(scree): the simulation's targets, with scree:: before their names, and the library that they link by target.
list(APPEND CMAKE_MODULE_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
include(CMakeFindDependencyMacro)
find_dependency(OpenVDB)
include(${CMAKE_CURRENT_LIST_DIR}/screeTargets.cmake)

# Every library that MOVIS is built on, found once. Included by the build and, installed, by find_package(movis).
include(CMakeFindDependencyMacro)

# VISPConfig.cmake appends flags to CMAKE_CXX_FLAGS and sets CMAKE_CXX_STANDARD for the whole project: put both back.
set(_movis_cxx_flags "${CMAKE_CXX_FLAGS}")
set(_movis_cxx_standard ${CMAKE_CXX_STANDARD})  # may be unset
find_dependency(VISP 3.5)
set(CMAKE_CXX_FLAGS "${_movis_cxx_flags}")
set(CMAKE_CXX_STANDARD ${_movis_cxx_standard})

find_dependency(Eigen3 3.4)
find_dependency(OpenCV 4.6 COMPONENTS core imgproc imgcodecs)
find_dependency(yaml-cpp 0.7)
find_dependency(fmt 9)
find_dependency(hwy 1.0)
find_dependency(box2d 2.4)
find_dependency(Ceres 2.1)
find_dependency(Threads)

# FLANN's headers (Debian: libflann-dev, liblz4-dev) as the target FLANN::FLANN.
find_path(FLANN_INCLUDE_DIR flann/flann.hpp)
find_library(FLANN_LZ4_LIBRARY lz4)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FLANN REQUIRED_VARS FLANN_INCLUDE_DIR FLANN_LZ4_LIBRARY)
if(FLANN_FOUND AND NOT TARGET FLANN::FLANN)
    add_library(FLANN::FLANN INTERFACE IMPORTED)
    set_target_properties(FLANN::FLANN PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${FLANN_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "${FLANN_LZ4_LIBRARY}")
endif()
mark_as_advanced(FLANN_INCLUDE_DIR FLANN_LZ4_LIBRARY)

# Dear ImGui with its GLFW and OpenGL 3 backends (Debian: libimgui-dev, libstb-dev, libfreetype-dev) as the target
# ImGui::ImGui. GLFW must have been found before. Debian's archive leans on the system's stb and FreeType.
find_package(Freetype QUIET)
find_path(ImGui_INCLUDE_DIR imgui_freetype.h PATH_SUFFIXES imgui)
find_library(ImGui_LIBRARY imgui)
find_library(ImGui_STB_LIBRARY stb)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ImGui REQUIRED_VARS ImGui_LIBRARY ImGui_STB_LIBRARY ImGui_INCLUDE_DIR FREETYPE_FOUND)
if(ImGui_FOUND AND NOT TARGET ImGui::ImGui)
    add_library(ImGui::ImGui UNKNOWN IMPORTED)
    set_target_properties(ImGui::ImGui PROPERTIES IMPORTED_LOCATION "${ImGui_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${ImGui_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "glfw;Freetype::Freetype;${ImGui_STB_LIBRARY};${CMAKE_DL_LIBS}")
endif()
mark_as_advanced(ImGui_INCLUDE_DIR ImGui_LIBRARY ImGui_STB_LIBRARY)

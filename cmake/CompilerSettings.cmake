# Settings every target of the project shares.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# What `./dev sanitize` turns on, for all that is compiled here. Without null and vptr: AddressSanitizer sees what goes
# through a null pointer, and types of libraries that keep their type information to themselves would be reported.
set(PST_SANITIZE "" CACHE STRING "address (with undefined behaviour) or thread: build for a sanitizer of the compiler")
if(PST_SANITIZE STREQUAL "address")
  set(_sanitizers -fsanitize=address,undefined,float-cast-overflow -fno-sanitize=null,vptr -fno-sanitize-recover=all)
elseif(PST_SANITIZE STREQUAL "thread")
  set(_sanitizers -fsanitize=thread)
elseif(PST_SANITIZE)
  message(FATAL_ERROR "PST_SANITIZE is '${PST_SANITIZE}'; there are: address, thread")
endif()
if(PST_SANITIZE)
  add_compile_options(${_sanitizers} -fno-omit-frame-pointer)
  add_link_options(${_sanitizers})
endif()

# -ffp-contract=off: multiplications and additions are fused where the kernels say so, and nowhere else, so that every
# processor gives the same bytes. -fno-semantic-interposition: nobody replaces single functions of the library, so that the
# compiler may inline them. -fno-math-errno: nobody asks errno about a square root, which is then one instruction.
function(pst_compile_settings target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -ffp-contract=off
    -fno-semantic-interposition -fno-math-errno)
  if(PST_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# Writes house.json into the build folder: what the scripts of tests/, docs/ and bench/ need to know
# of the components that were configured.

function(gslam_write_facts)
  set(entries "")
  get_property(components GLOBAL PROPERTY GSLAM_COMPONENTS)
  foreach(name IN LISTS components)
    foreach(field IN ITEMS VERSION KIND STANDARD SUMMARY DEPENDS FOLDER GENERATED)
      get_property(${field} GLOBAL PROPERTY GSLAM_${name}_${field})
    endforeach()
    set(depends "")
    while(DEPENDS)
      list(POP_FRONT DEPENDS dependency least)
      list(APPEND depends "\"${dependency}\": \"${least}\"")
    endwhile()
    string(REPLACE ";" ", " depends "${depends}")
    list(APPEND entries "    {\"name\": \"${name}\", \"version\": \"${VERSION}\", \"kind\": \"${KIND}\",
     \"standard\": ${STANDARD}, \"summary\": \"${SUMMARY}\", \"depends\": {${depends}},
     \"folder\": \"${FOLDER}\", \"generated\": \"${GENERATED}\"}")
  endforeach()
  get_property(programs GLOBAL PROPERTY GSLAM_PROGRAMS)
  list(TRANSFORM programs REPLACE "(.+)" "\"\\1\"")
  string(REPLACE ";" ", " programs "${programs}")
  string(REPLACE ";" ",\n" entries "${entries}")
  file(WRITE "${CMAKE_BINARY_DIR}/house.json.new"
    "{\n  \"source\": \"${GSLAM_SOURCE_ROOT}\",\n  \"build\": \"${CMAKE_BINARY_DIR}\",\n"
    "  \"generator\": \"${CMAKE_GENERATOR}\",\n  \"version\": \"${PROJECT_VERSION}\",\n"
    "  \"programs\": [${programs}],\n"
    "  \"components\": [\n${entries}\n  ]\n}\n")
  configure_file("${CMAKE_BINARY_DIR}/house.json.new" "${CMAKE_BINARY_DIR}/house.json" COPYONLY)
endfunction()

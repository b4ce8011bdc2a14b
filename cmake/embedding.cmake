# pliant_embed_scenes(SCENES FOLDER … HEADER … NAMESPACE … FUNCTION … OUTPUT …): scenes as a part of a program, see
# embed_scenes.cmake. The list of scenes stands in the command line, so that the command runs again when a scene comes or
# goes, and among the dependencies, so that it does when one changes.
set(pliant_embed_script "${CMAKE_CURRENT_LIST_DIR}/embed_scenes.cmake")

function(pliant_embed_scenes scenes)
  cmake_parse_arguments(PARSE_ARGV 1 embed "" "FOLDER;HEADER;NAMESPACE;FUNCTION;OUTPUT" "")
  list(JOIN scenes "|" scene_argument)
  add_custom_command(
    OUTPUT "${embed_OUTPUT}"
    COMMAND "${CMAKE_COMMAND}" "-Dscenes=${scene_argument}" "-Dfolder=${embed_FOLDER}" "-Dheader=${embed_HEADER}"
      "-Dnamespace=${embed_NAMESPACE}" "-Dfunction=${embed_FUNCTION}" "-Doutput=${embed_OUTPUT}" -P "${pliant_embed_script}"
    DEPENDS ${scenes} "${pliant_embed_script}"
    COMMENT "Embedding the scenes of ${embed_FOLDER}"
    VERBATIM)
endfunction()

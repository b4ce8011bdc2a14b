#include "render/gl_objects.h"

#include <array>
#include <stdexcept>
#include <string>

namespace pliant_render {
namespace {

GLuint compile(GLenum stage, std::string_view source) {
  const GLuint shader = glCreateShader(stage);
  const char* const text = source.data();
  const auto length = static_cast<GLint>(source.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint succeeded = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &succeeded);
  if (succeeded != 0) return shader;
  std::array<char, 2000> message{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(message.size()), nullptr, message.data());
  glDeleteShader(shader);
  throw std::logic_error(std::string("a shader does not compile: ") + message.data());
}

}  // namespace

Program::Program(std::string_view vertex, std::string_view geometry, std::string_view fragment)
    : id_(glCreateProgram()) {
  const auto attach = [this](GLenum stage, std::string_view source) {
    if (source.empty()) return;
    const GLuint shader = compile(stage, source);
    glAttachShader(id_, shader);
    glDeleteShader(shader);  // once the program goes
  };
  attach(GL_VERTEX_SHADER, vertex);
  attach(GL_GEOMETRY_SHADER, geometry);
  attach(GL_FRAGMENT_SHADER, fragment);
  glLinkProgram(id_);
  GLint succeeded = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &succeeded);
  if (succeeded != 0) return;
  std::array<char, 2000> message{};
  glGetProgramInfoLog(id_, static_cast<GLsizei>(message.size()), nullptr, message.data());
  throw std::logic_error(std::string("a program does not link: ") + message.data());
}

Program::~Program() {
  glDeleteProgram(id_);
}

void set_up_texture(const Texture& texture, GLenum format, int width, int height, const void* pixels) {
  const bool is_mask = format != GL_RGB8;
  const GLenum channels = format == GL_R8 ? GL_RED : format == GL_RGB8 ? GL_RGB : GL_RGBA;
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, channels, GL_UNSIGNED_BYTE, pixels);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, is_mask ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, is_mask ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE);
}

}  // namespace pliant_render

#pragma once
// OpenGL objects with automatic lifetime. Their context must be current whenever they are made, used or destroyed.
#include <span>
#include <string_view>
#include <vector>

#include <epoxy/gl.h>

#include "render/vectors.h"

namespace pliant_render {

/// Owns the name of one OpenGL object.
template <auto& generate, auto& remove>
class GlObject {
 public:
  GlObject() { generate(1, &id_); }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() { remove(1, &id_); }
  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

using Buffer = GlObject<glGenBuffers, glDeleteBuffers>;
using VertexArray = GlObject<glGenVertexArrays, glDeleteVertexArrays>;
using Texture = GlObject<glGenTextures, glDeleteTextures>;
using Renderbuffer = GlObject<glGenRenderbuffers, glDeleteRenderbuffers>;
using Framebuffer = GlObject<glGenFramebuffers, glDeleteFramebuffers>;

/// A linked shader program.
class Program {
 public:
  /// Compiles the sources of the stages; empty ones are left out. @throws std::logic_error with the driver's message.
  Program(std::string_view vertex, std::string_view geometry, std::string_view fragment);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  void use() const { glUseProgram(id_); }
  /// Sets a uniform; the program must be in use.
  void set(const char* name, int value) const { glUniform1i(place(name), value); }
  void set(const char* name, float value) const { glUniform1f(place(name), value); }
  void set(const char* name, const Vec2f& value) const { glUniform2fv(place(name), 1, value.data()); }
  void set(const char* name, const Vec3f& value) const { glUniform3fv(place(name), 1, value.data()); }
  void set(const char* name, const Vec4f& value) const { glUniform4fv(place(name), 1, value.data()); }
  void set(const char* name, std::span<const Vec3f> values) const {
    glUniform3fv(place(name), static_cast<GLsizei>(values.size()), values.front().data());
  }
  void set(const char* name, const Mat3f& value) const { glUniformMatrix3fv(place(name), 1, GL_FALSE, value.data()); }
  void set(const char* name, const Mat4f& value) const { glUniformMatrix4fv(place(name), 1, GL_FALSE, value.data()); }

 private:
  GLint place(const char* name) const { return glGetUniformLocation(id_, name); }

  GLuint id_;
};

/// Copies the list into the buffer.
template <class T>
void upload(const Buffer& buffer, GLenum target, const std::vector<T>& list, GLenum usage) {
  glBindBuffer(target, buffer.id());
  glBufferData(target, static_cast<GLsizeiptr>(list.size() * sizeof(T)), list.data(), usage);
}

/// Fills a texture with pixels, row by row from the top: GL_RGB8, three bytes each, or GL_R8 and GL_RGBA8, one
/// and four each, which are 0 beyond their edges. pixels: null for none yet.
void set_up_texture(const Texture& texture, GLenum format, int width, int height, const void* pixels);

}  // namespace pliant_render

// SPDX-License-Identifier: BSD-3-Clause
// Owners of OpenGL objects: programs, and vertex arrays with their buffers. A context must be current.
#pragma once

#include <epoxy/gl.h>

#include <Eigen/Core>
#include <span>
#include <string_view>

namespace polhode::viewer::inline drawing {

/// A vertex and a fragment shader, linked. `#version 330 core` is prepended to both.
class Program {
 public:
  Program(std::string_view vertex, std::string_view fragment);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  void use() const { glUseProgram(id_); }
  void set(const char* name, float value) const { glUniform1f(place(name), value); }
  void set(const char* name, const Eigen::Vector2f& value) const { glUniform2fv(place(name), 1, value.data()); }
  void set(const char* name, const Eigen::Vector3f& value) const { glUniform3fv(place(name), 1, value.data()); }
  void set(const char* name, const Eigen::Vector4f& value) const { glUniform4fv(place(name), 1, value.data()); }
  void set(const char* name, const Eigen::Matrix3f& value) const {
    glUniformMatrix3fv(place(name), 1, GL_FALSE, value.data());
  }
  void set(const char* name, const Eigen::Matrix4f& value) const {
    glUniformMatrix4fv(place(name), 1, GL_FALSE, value.data());
  }

 private:
  GLint place(const char* name) const { return glGetUniformLocation(id_, name); }
  GLuint id_ = 0;
};

/// A vertex array with two buffers: attributes by vertex, and attributes by instance.
class VertexArray {
 public:
  VertexArray();
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;
  ~VertexArray();

  enum class Per { vertex, instance };
  /// An attribute of `numbers` floats (or bytes, mapped to 0 to 1) at `offset` in records of `stride` bytes.
  void floats(Per per, GLuint location, int numbers, std::size_t stride, std::size_t offset);
  void bytes(Per per, GLuint location, int numbers, std::size_t stride, std::size_t offset);

  template <class Records>
  void vertices(std::span<Records> records) {
    upload(GL_ARRAY_BUFFER, buffers_[0], records.data(), records.size_bytes(), GL_STATIC_DRAW);
  }
  template <class Records>
  void instances(std::span<Records> records) {
    upload(GL_ARRAY_BUFFER, buffers_[1], records.data(), records.size_bytes(), GL_STREAM_DRAW);
  }
  void corners(std::span<const std::uint32_t> indices);

  void draw(GLenum shape, std::size_t vertices, std::size_t instances) const;
  /// Draws the triangles of the given corners.
  void draw_corners(std::size_t instances) const;

 private:
  void upload(GLenum kind, GLuint buffer, const void* data, std::size_t size, GLenum use);
  void attribute(Per per, GLuint location, int numbers, GLenum type, std::size_t stride, std::size_t offset);
  GLuint id_ = 0;
  GLuint buffers_[3] = {};  // vertices, instances, corners
  std::size_t corners_ = 0;
};

}  // namespace polhode::viewer::drawing

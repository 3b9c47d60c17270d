// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/gl_objects.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace polhode::viewer::inline drawing {

namespace {

GLuint compile(GLenum kind, std::string_view source) {
  const GLuint shader = glCreateShader(kind);
  const std::string text = "#version 330 core\n" + std::string(source);
  const char* start = text.c_str();
  glShaderSource(shader, 1, &start, nullptr);
  glCompileShader(shader);
  GLint done = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done != GL_TRUE) {
    std::array<char, 1024> log{};
    glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
    glDeleteShader(shader);
    throw std::runtime_error(std::string("the OpenGL driver refuses a shader: ") + log.data());
  }
  return shader;
}

}  // namespace

Program::Program(std::string_view vertex, std::string_view fragment) : id_(glCreateProgram()) {
  for (const GLuint shader : {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)}) {
    glAttachShader(id_, shader);
    glDeleteShader(shader);  // the program keeps it until it is deleted itself
  }
  glLinkProgram(id_);
  GLint done = GL_FALSE;
  glGetProgramiv(id_, GL_LINK_STATUS, &done);
  if (done != GL_TRUE) {
    std::array<char, 1024> log{};
    glGetProgramInfoLog(id_, GLsizei(log.size()), nullptr, log.data());
    glDeleteProgram(id_);
    throw std::runtime_error(std::string("the OpenGL driver refuses to link a shader: ") + log.data());
  }
}

Program::~Program() { glDeleteProgram(id_); }

VertexArray::VertexArray() {
  glGenVertexArrays(1, &id_);
  glGenBuffers(3, buffers_);
}

VertexArray::~VertexArray() {
  glDeleteBuffers(3, buffers_);
  glDeleteVertexArrays(1, &id_);
}

void VertexArray::attribute(Per per, GLuint location, int numbers, GLenum type, std::size_t stride,
                            std::size_t offset) {
  glBindVertexArray(id_);
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[per == Per::vertex ? 0 : 1]);
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, numbers, type, type == GL_UNSIGNED_BYTE, GLsizei(stride),
                        reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(location, per == Per::vertex ? 0 : 1);
}

void VertexArray::floats(Per per, GLuint location, int numbers, std::size_t stride, std::size_t offset) {
  attribute(per, location, numbers, GL_FLOAT, stride, offset);
}

void VertexArray::bytes(Per per, GLuint location, int numbers, std::size_t stride, std::size_t offset) {
  attribute(per, location, numbers, GL_UNSIGNED_BYTE, stride, offset);
}

void VertexArray::upload(GLenum kind, GLuint buffer, const void* data, std::size_t size, GLenum use) {
  glBindVertexArray(id_);
  glBindBuffer(kind, buffer);
  glBufferData(kind, GLsizeiptr(size), data, use);
}

void VertexArray::corners(std::span<const std::uint32_t> indices) {
  corners_ = indices.size();
  upload(GL_ELEMENT_ARRAY_BUFFER, buffers_[2], indices.data(), indices.size_bytes(), GL_STATIC_DRAW);
}

void VertexArray::draw(GLenum shape, std::size_t vertices, std::size_t instances) const {
  glBindVertexArray(id_);
  glDrawArraysInstanced(shape, 0, GLsizei(vertices), GLsizei(instances));
}

void VertexArray::draw_corners(std::size_t instances) const {
  glBindVertexArray(id_);
  glDrawElementsInstanced(GL_TRIANGLES, GLsizei(corners_), GL_UNSIGNED_INT, nullptr, GLsizei(instances));
}

}  // namespace polhode::viewer::drawing

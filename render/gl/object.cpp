#include "render/gl/object.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace render::gl {
namespace {

GLuint created(void (*create)(GLsizei, GLuint*)) {
    GLuint id = 0;
    create(1, &id);
    return id;
}

GLuint createdTexture(GLenum target) {
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    return id;
}

void deleteTexture(GLuint id) { glDeleteTextures(1, &id); }

}  // namespace

Buffer::Buffer(std::size_t bytes, const void* contents)
    : Object(created([](GLsizei n, GLuint* id) { glCreateBuffers(n, id); }),
             [](GLuint id) { glDeleteBuffers(1, &id); }),
      bytes_(bytes) {
    // A buffer of no bytes is an error in GL; one word stands for it.
    const std::size_t held = bytes > 0 ? bytes : 4;
    glNamedBufferStorage(id(), static_cast<GLsizeiptr>(held), bytes > 0 ? contents : nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    GLint size = 0;
    glGetNamedBufferParameteriv(id(), GL_BUFFER_IMMUTABLE_STORAGE, &size);
    if (size != GL_TRUE)
        throw std::runtime_error(
            fmt::format("the GL driver has no {} bytes left for a buffer", bytes));
}

void Buffer::write(std::size_t offset, std::size_t bytes, const void* contents) {
    if (bytes > 0)
        glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                             contents);
}

void Buffer::bindStorage(GLuint place) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, place, id());
}

Texture::Texture(GLenum internalFormat, glm::ivec2 size, int levels)
    : Object(createdTexture(GL_TEXTURE_2D), deleteTexture), size_(size) {
    glTextureStorage2D(id(), levels, internalFormat, size.x, size.y);
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER,
                        levels == 1 ? GL_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, levels == 1 ? GL_NEAREST : GL_LINEAR);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

BufferTexture::BufferTexture(GLenum internalFormat, const Buffer& buffer)
    : Object(createdTexture(GL_TEXTURE_BUFFER), deleteTexture) {
    glTextureBuffer(id(), internalFormat, buffer.id());
}

Framebuffer::Framebuffer(std::span<const GLuint> colors, GLuint depth)
    : Object(created([](GLsizei n, GLuint* id) { glCreateFramebuffers(n, id); }),
             [](GLuint id) { glDeleteFramebuffers(1, &id); }) {
    std::vector<GLenum> drawn;
    for (const GLuint color : colors) {
        drawn.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawn.size()));
        glNamedFramebufferTexture(id(), drawn.back(), color, 0);
    }
    glNamedFramebufferDrawBuffers(id(), static_cast<GLsizei>(drawn.size()), drawn.data());
    if (depth != 0) glNamedFramebufferTexture(id(), GL_DEPTH_ATTACHMENT, depth, 0);
    const GLenum status = glCheckNamedFramebufferStatus(id(), GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error(
            fmt::format("the GL driver cannot draw into this framebuffer (status {:#x})", status));
}

namespace {

GLuint createdQuery(GLenum target) {
    GLuint id = 0;
    glCreateQueries(target, 1, &id);
    return id;
}

}  // namespace

Query::Query(GLenum target)
    : Object(createdQuery(target), [](GLuint id) { glDeleteQueries(1, &id); }) {}

VertexArray::VertexArray()
    : Object(created([](GLsizei n, GLuint* id) { glCreateVertexArrays(n, id); }),
             [](GLuint id) { glDeleteVertexArrays(1, &id); }) {}

void VertexArray::setElements(const Buffer& indices) {
    glVertexArrayElementBuffer(id(), indices.id());
}

void VertexArray::attach(const Attribute& a) {
    // One binding an attribute: location and binding are the same number.
    glEnableVertexArrayAttrib(id(), a.location);
    glVertexArrayVertexBuffer(id(), a.location, a.buffer.id(), 0, a.stride);
    if (a.type == GL_FLOAT || a.normalized) {
        glVertexArrayAttribFormat(id(), a.location, a.components, a.type, a.normalized, a.offset);
    } else {
        glVertexArrayAttribIFormat(id(), a.location, a.components, a.type, a.offset);
    }
    glVertexArrayAttribBinding(id(), a.location, a.location);
}

namespace {

Object compiled(GLenum stage, const char* name, const char* source, const char* defines) {
    Object shader(glCreateShader(stage), [](GLuint id) { glDeleteShader(id); });
    constexpr const char* kVersion = "#version 450 core\n";
    const std::array<const char*, 3> parts = {kVersion, defines, source};
    glShaderSource(shader.id(), parts.size(), parts.data(), nullptr);
    glCompileShader(shader.id());
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    const char* const of = stage == GL_VERTEX_SHADER     ? "vertex"
                           : stage == GL_FRAGMENT_SHADER ? "fragment"
                                                         : "compute";
    throw std::runtime_error(
        fmt::format("the GL driver refuses shader {} ({}): {}", name, of, log));
}

}  // namespace

Program::Program(const char* name, std::span<const Object> shaders)
    : Object(glCreateProgram(), [](GLuint id) { glDeleteProgram(id); }) {
    for (const Object& shader : shaders) glAttachShader(id(), shader.id());
    glLinkProgram(id());
    for (const Object& shader : shaders) glDetachShader(id(), shader.id());
    GLint ok = GL_FALSE;
    glGetProgramiv(id(), GL_LINK_STATUS, &ok);
    if (ok == GL_TRUE) return;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(id(), static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw std::runtime_error(fmt::format("the GL driver cannot link shader {}: {}", name, log));
}

Program::Program(const char* name, const char* vertex, const char* fragment, const char* defines)
    : Program(name, std::array{compiled(GL_VERTEX_SHADER, name, vertex, defines),
                               compiled(GL_FRAGMENT_SHADER, name, fragment, defines)}) {}

Program Program::ofCompute(const char* name, const char* source, const char* defines) {
    return Program(name, std::array{compiled(GL_COMPUTE_SHADER, name, source, defines)});
}

}  // namespace render::gl

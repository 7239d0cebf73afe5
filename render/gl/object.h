// GL objects as move-only values. Made after a context is current, destroyed before it goes.
#pragma once

#include <epoxy/gl.h>

#include <glm/vec2.hpp>
#include <span>
#include <utility>

namespace render::gl {

// An owned name and how to delete it.
class Object {
 public:
    using Delete = void (*)(GLuint);
    Object(GLuint id, Delete destroy) : id_(id), destroy_(destroy) {}
    Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)), destroy_(other.destroy_) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    ~Object() {
        if (id_ != 0) destroy_(id_);
    }
    GLuint id() const { return id_; }

 private:
    GLuint id_;
    Delete destroy_;
};

// Immutable size; contents may be replaced with write().
class Buffer : public Object {
 public:
    explicit Buffer(std::size_t bytes, const void* contents = nullptr);
    template <typename T>
    explicit Buffer(std::span<const T> contents) : Buffer(contents.size_bytes(), contents.data()) {}
    void write(std::size_t offset, std::size_t bytes, const void* contents);
    void bindStorage(GLuint place) const;  // for shaders that read or write it
    std::size_t bytes() const { return bytes_; }

 private:
    std::size_t bytes_;
};

// 2-D, clamped. One level is taken as it is (nearest), several are blended.
class Texture : public Object {
 public:
    Texture(GLenum internalFormat, glm::ivec2 size, int levels = 1);
    glm::ivec2 size() const { return size_; }

 private:
    glm::ivec2 size_;
};

// A buffer read by texelFetch(samplerBuffer).
class BufferTexture : public Object {
 public:
    BufferTexture(GLenum internalFormat, const Buffer& buffer);
};

// Colour attachments in order, and a depth attachment when given. Refers to the textures.
class Framebuffer : public Object {
 public:
    explicit Framebuffer(std::span<const GLuint> colors, GLuint depth = 0);
};

class Query : public Object {
 public:
    explicit Query(GLenum target);
};

class VertexArray : public Object {
 public:
    VertexArray();
    struct Attribute {
        GLuint location;
        const Buffer& buffer;
        GLint components;
        GLenum type;  // unsigned types arrive as integers
        GLsizei stride;
        GLuint offset = 0;
        bool normalized = false;  // unsigned bytes as [0, 1] floats
    };
    void attach(const Attribute& attribute);
    void setElements(const Buffer& indices);
};

// Shaders, linked. Throws std::runtime_error with the driver's log.
class Program : public Object {
 public:
    // `name` is for messages; `defines` is put after the #version line of both.
    Program(const char* name, const char* vertex, const char* fragment, const char* defines = "");
    // Of a compute shader alone.
    static Program ofCompute(const char* name, const char* source, const char* defines = "");

 private:
    Program(const char* name, std::span<const Object> shaders);
};

}  // namespace render::gl

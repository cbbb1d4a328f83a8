#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/Importer.hpp>

#include "mesh_soup.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

Vec3f transformed(const aiMatrix4x4& transform, const aiVector3D& point) {
  // Multiplying by the identity would turn −0 into 0.
  const aiVector3D p = transform.IsIdentity() ? point : transform * point;
  return Vec3f(p.x, p.y, p.z);
}

void append_faces(const aiMesh& mesh, std::uint32_t first_vertex, MeshSoup& soup) {
  for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    for (unsigned int k = 0; k < face.mNumIndices; ++k) {
      // A wrong index must stay wrong, whatever comes behind this mesh.
      const bool is_there = face.mIndices[k] < mesh.mNumVertices;
      soup.corners.push_back(is_there ? first_vertex + face.mIndices[k] : 0xffffffffU);
    }
    soup.polygon_ends.push_back(soup.corners.size());
  }
}

void append_mesh(const aiMesh& mesh, const aiMatrix4x4& transform, MeshSoup& soup) {
  const auto first_vertex = static_cast<std::uint32_t>(soup.positions.size());
  for (unsigned int v = 0; v < mesh.mNumVertices; ++v) {
    soup.positions.push_back(transformed(transform, mesh.mVertices[v]));
  }
  if (mesh.HasVertexColors(0)) {
    soup.colors.resize(first_vertex, {1.0F, 1.0F, 1.0F, 1.0F});
    for (unsigned int v = 0; v < mesh.mNumVertices; ++v) {
      const aiColor4D& c = mesh.mColors[0][v];
      soup.colors.push_back({c.r, c.g, c.b, c.a});
    }
  }
  if (mesh.HasTextureCoords(0)) {
    soup.texcoords.resize(first_vertex, {0.0F, 0.0F});
    for (unsigned int v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& t = mesh.mTextureCoords[0][v];
      soup.texcoords.push_back({t.x, t.y});
    }
  }
  append_faces(mesh, first_vertex, soup);
}

void append_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, MeshSoup& soup) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  for (unsigned int m = 0; m < node.mNumMeshes; ++m) append_mesh(*scene.mMeshes[node.mMeshes[m]], transform, soup);
  for (unsigned int n = 0; n < node.mNumChildren; ++n) append_node(scene, *node.mChildren[n], transform, soup);
}

}  // namespace

MeshSoup parse_with_assimp(const std::string& content, const std::string& extension) {
  // No post-processing: its triangulation trusts the indices of the file.
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(content.data(), content.size(), 0, extension.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw InputError(fmt::format("assimp says: {}", importer.GetErrorString()));
  }
  MeshSoup soup;
  append_node(*scene, *scene->mRootNode, aiMatrix4x4(), soup);
  if (!soup.colors.empty()) soup.colors.resize(soup.positions.size(), {1.0F, 1.0F, 1.0F, 1.0F});
  if (!soup.texcoords.empty()) soup.texcoords.resize(soup.positions.size(), {0.0F, 0.0F});
  return soup;
}

}  // namespace particle_surface_tracker

#include "particle_surface_tracker/io/gltf_writer.h"

#include <memory>
#include <string_view>

#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/Exporter.hpp>

#include "file_bytes.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/vertex_normals.h"

// Raw pointers below are assimp's: a scene owns all that it points to, and deletes it.

namespace particle_surface_tracker {
namespace {

/// The values of an attribute that glTF has a place for; none if there is no such attribute of that many components.
const float* find_values(const VertexAttributes& attributes, const char* name, std::size_t components) {
  const std::size_t index = attributes.find(name);
  if (index == VertexAttributes::none || attributes[index].components != components) return nullptr;
  return attributes[index].values.data();
}

aiVector3D to_assimp(const Vec3f& v) {
  return {v.x(), v.y(), v.z()};
}

void set_vertices(const TriangleMesh& mesh, aiMesh& out) {
  const std::vector<Vec3f> normals = vertex_normals(mesh.positions(), mesh.triangles());
  const float* colors = find_values(mesh.attributes(), TriangleMesh::color_name, 4);
  const float* texcoords = find_values(mesh.attributes(), TriangleMesh::texcoord_name, 2);
  out.mNumVertices = static_cast<unsigned int>(mesh.vertex_count());
  out.mVertices = new aiVector3D[mesh.vertex_count()];
  out.mNormals = new aiVector3D[mesh.vertex_count()];
  if (colors != nullptr) out.mColors[0] = new aiColor4D[mesh.vertex_count()];
  if (texcoords != nullptr) {
    out.mTextureCoords[0] = new aiVector3D[mesh.vertex_count()];
    out.mNumUVComponents[0] = 2;
  }
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    out.mVertices[v] = to_assimp(mesh.positions()[v]);
    out.mNormals[v] = to_assimp(normals[v]);
    if (colors != nullptr) {
      const float* c = colors + 4 * v;
      out.mColors[0][v] = aiColor4D(c[0], c[1], c[2], c[3]);
    }
    if (texcoords != nullptr) out.mTextureCoords[0][v] = aiVector3D(texcoords[2 * v], texcoords[2 * v + 1], 0.0F);
  }
}

void set_triangles(const TriangleMesh& mesh, aiMesh& out) {
  out.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  out.mNumFaces = static_cast<unsigned int>(mesh.triangle_count());
  out.mFaces = new aiFace[mesh.triangle_count()];
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    aiFace& face = out.mFaces[t];
    face.mNumIndices = 3;
    face.mIndices = new unsigned int[3]{mesh.triangles()[t][0], mesh.triangles()[t][1], mesh.triangles()[t][2]};
  }
}

std::unique_ptr<aiScene> to_scene(const TriangleMesh& mesh) {
  auto scene = std::make_unique<aiScene>();
  scene->mNumMaterials = 1;
  // The scene deletes all of it, out of the analyzer's sight.
  scene->mMaterials = new aiMaterial* [1] { new aiMaterial() };  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks)
  scene->mNumMeshes = 1;
  scene->mMeshes = new aiMesh* [1] { new aiMesh() };  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks)
  scene->mRootNode = new aiNode("liquid");
  scene->mRootNode->mNumMeshes = 1;
  scene->mRootNode->mMeshes = new unsigned int[1]{0};
  set_vertices(mesh, *scene->mMeshes[0]);
  set_triangles(mesh, *scene->mMeshes[0]);
  return scene;
}

}  // namespace

void write_glb(const std::string& path, const TriangleMesh& mesh) {
  const std::unique_ptr<aiScene> scene = to_scene(mesh);
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(scene.get(), "glb2");
  if (blob == nullptr)
    throw OutputError(fmt::format("'{}' cannot be made: assimp says: {}", path, exporter.GetErrorString()));
  write_file_whole(path, std::string_view(static_cast<const char*>(blob->data), blob->size));
}

}  // namespace particle_surface_tracker

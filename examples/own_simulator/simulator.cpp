// A simulator of a falling block, which publishes its particles for the tracker.
#include <cstring>
#include <vector>

#include <ros/ros.h>
#include <sensor_msgs/point_cloud2_iterator.h>

struct Particle {
  float x, y, z;
  std::uint32_t id;  // Stays with the particle, wherever it is in the array.
};

sensor_msgs::PointCloud2 to_cloud(const std::vector<Particle>& particles, const ros::Time& stamp) {
  using Field = sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = stamp;
  cloud.header.frame_id = "world";
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(4, "x", 1, Field::FLOAT32, "y", 1, Field::FLOAT32, "z", 1, Field::FLOAT32,  //
                                "id", 1, Field::UINT32);
  modifier.resize(particles.size());
  std::memcpy(cloud.data.data(), particles.data(), cloud.data.size());
  return cloud;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  ros::NodeHandle node;
  const auto publisher = node.advertise<sensor_msgs::PointCloud2>("particles", 100);
  // What is published before somebody listens is lost, and the mesh belongs to the first frame.
  while (ros::ok() && publisher.getNumSubscribers() == 0) ros::WallDuration(0.1).sleep();

  std::vector<Particle> particles;
  for (std::uint32_t id = 0; id < 1000; ++id) {
    const std::uint32_t row = id / 10, layer = id / 100;
    particles.push_back({0.05F * (id % 10), 0.05F * (row % 10), 0.05F * layer, id});
  }
  ros::WallRate rate(30);  // Not faster than the tracker; simulated time is that of the stamps.
  for (int frame = 0; ros::ok() && frame < 20; ++frame) {
    publisher.publish(to_cloud(particles, ros::Time(1000) + ros::Duration(frame / 60.0)));
    for (Particle& particle : particles) particle.z -= 9.81F * (2 * frame + 1) / 7200;  // g t²/2, t = frame/60 s
    rate.sleep();
  }
  ros::WallDuration(1).sleep();  // The last frames are still on their way.
}

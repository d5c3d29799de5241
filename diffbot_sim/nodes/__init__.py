"""The ROS 2 nodes: shells around the core, and the only room that knows rclpy and messages."""

"""`ial odometer …`: a robot with a linear and an angular odometer."""

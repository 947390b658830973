"""What a scan says: beams and rays in the frame of the robot, with how wrong they may be."""

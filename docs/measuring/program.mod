MODULE Part
  PERS tooldata artifact:=[TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];
  PROC main()
    MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;
    MoveL [[300.00,0.00,260.00],[0.0,1.0,0.0,0.0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;
    MoveL [[380.00,50.00,260.00],[0.0,1.0,0.0,0.0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;
  ENDPROC
ENDMODULE

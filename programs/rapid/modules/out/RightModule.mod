MODULE RightModule
    PROC Path_Right()
        MoveJ Home,v1000,z50,tProbe\WObj:=wLeft;
        MoveL Right_10,v200,z1,tProbe\WObj:=wRight;
        MoveL Right_20,v200,z1,tProbe\WObj:=wRight;
        MoveL Right_30,v200,z1,tProbe\WObj:=wRight;
        MoveL Right_40,v200,fine,tProbe\WObj:=wRight;
        MoveL Right_10,v200,fine,tProbe\WObj:=wRight;
    ENDPROC
ENDMODULE
